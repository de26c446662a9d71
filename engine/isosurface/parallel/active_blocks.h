// Which cells of a pillar are worth reading: boxes around the bricks that the isovalue crosses, small enough
// for memory. Plain arithmetic without MPI.
#pragma once
#include <vector>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

inline std::size_t place_of(const Bricks& bricks, const survey::Index& brick) {
  return static_cast<std::size_t>((brick[0] * bricks.dims[1] + brick[1]) * bricks.dims[2] + brick[2]);
}
// Whether a brick may hold triangles: a sample below the isovalue and one at or above it.
inline bool is_active(const Bricks& bricks, const survey::Index& brick, float isovalue) {
  const std::size_t n = place_of(bricks, brick);
  return bricks.min[n] < isovalue && isovalue <= bricks.max[n];
}

// What makes a brick worth looking at.
struct Wanted {
  const Bricks* bricks = nullptr;  // of the whole volume; null: every cell counts
  float isovalue = 0;
  // Also bricks at the volume's border with samples at or above the isovalue: they may have caps.
  bool caps = false;
  std::int64_t most_cells = 0;  // of a block
};

// Disjoint boxes of cells inside `cells` that hold all its wanted bricks, cut where much of a box is empty
// and where a box has more than `most_cells`; ascending by their first inline, crossline, sample. A box is
// never cut below 8 cells of an axis.
std::vector<survey::Box> active_blocks(const survey::Box& cells, const Wanted& wanted);

}  // namespace footwall::isosurface
