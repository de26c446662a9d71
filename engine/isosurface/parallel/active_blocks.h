// Which cells of a pillar are worth reading: boxes around the bricks that the isovalue crosses, small enough
// for memory. Plain arithmetic without MPI.
#pragma once
#include <vector>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// Whether a brick may hold triangles: a sample below the isovalue and one at or above it.
inline bool is_active(const Bricks& bricks, const survey::Index& brick, float isovalue) {
  const auto n = static_cast<std::size_t>((brick[0] * bricks.dims[1] + brick[1]) * bricks.dims[2] + brick[2]);
  return bricks.min[n] < isovalue && isovalue <= bricks.max[n];
}

// Disjoint boxes of cells inside `cells` that hold all its active bricks, cut where much of a box is empty
// and where a box has more than `most_cells`; ascending by their first inline, crossline, sample. bricks: of
// the whole volume; null: every cell counts. A box is never cut below 8 cells of an axis.
std::vector<survey::Box> active_blocks(const survey::Box& cells, const Bricks* bricks, float isovalue,
                                       std::int64_t most_cells);

}  // namespace footwall::isosurface
