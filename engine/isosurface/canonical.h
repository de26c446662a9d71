// One form for surfaces that are alike but for the order of their parts: of parts of a volume welded
// together, of other decompositions, of other algorithms. Bit for bit, so that "the same" is not a matter of
// tolerance.
#pragma once
#include <optional>
#include <string>

#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

// Vertices ascend by key, each triangle starts with its smallest vertex (the winding stays), triangles
// ascend. Normals are there if the surface has them; `cells` are kept, row_first is left empty, since
// triangles no longer stand by their cells. Throws Error kInvalid for a surface without keys or with one key
// twice.
Surface canonical(const Surface& surface);

// The first difference between two surfaces as they stand, in words with the numbers of both ("vertex 17 on
// the k edge of sample (3, 4, 5): k is 5.25 here and 5.5 there"); nothing where counts, keys, positions,
// normals and triangles agree bit for bit. Keys and normals are compared where both have them; a surface of
// vertices that has them differs from one that has not, for normals.
std::optional<std::string> difference(const Surface& here, const Surface& there,
                                      const survey::Index& volume_size);
// The same in canonical form: order counts for nothing.
std::optional<std::string> difference_but_for_order(const Surface& here, const Surface& there,
                                                    const survey::Index& volume_size);

// What a key stands for. The volume's size is the one that the key was made with.
struct KeyPlace {
  survey::Index sample{0, 0, 0};
  int axis = 0;  // 3: centre of the cell
};
KeyPlace place_of(VertexKey key, const survey::Index& volume_size);
VertexKey key_of(const survey::Index& sample, int axis, const survey::Index& volume_size);

}  // namespace footwall::isosurface
