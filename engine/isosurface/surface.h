// An isosurface as indexed triangles.
//
// Order, the same for every variant, thread count and instruction set: vertices and triangles ascend by the
// row (i, j) that they belong to. A vertex belongs to the lower end of its lattice edge (or to its cell, if
// it is a centre); inside a row the vertices on k edges come first, then those on j edges, on i edges, and
// centres, each ascending by k. A triangle belongs to its cell; inside a row triangles ascend by k, inside a
// cell in the order of the case's pattern.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/isosurface/page_vector.h"
#include "storage/survey/box.h"

namespace footwall::isosurface {

struct Point {
  float i = 0;
  float j = 0;
  float k = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
using Triangle = std::array<std::uint32_t, 3>;

// The place of a vertex, the same in all parts of a volume: 4 * ((i * nj + j) * nk + k) + axis, for the
// lattice edge from sample (i, j, k) along axis 0, 1, 2; axis 3: the centre vertex of the cell (i, j, k).
using VertexKey = std::uint64_t;

struct Surface {
  PageVector<Point> positions;  // index space of the volume
  PageVector<Point> normals;    // unit vectors in index space, to lower values; none if not asked for
  // Counter-clockwise as seen from lower values, in the right-handed frame of axes i, j, k.
  PageVector<Triangle> triangles;
  PageVector<VertexKey> keys;  // one per vertex; none if not asked for

  // The cells that were looked at, as the volume counts them, and the first triangle of each of their rows
  // (i, j), [i][j], with the number of triangles at its end.
  survey::Box cells;
  std::vector<std::uint64_t> row_first;
};

}  // namespace footwall::isosurface
