#include <algorithm>
#include <limits>

#include "engine/isosurface/visible/paper/visible_paper.h"

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kAlongAxis = 32;

// The ranges of leaves of so many bricks along each axis.
BrickRanges joined(const Bricks& bricks, const survey::Index& leaf_bricks) {
  BrickRanges leaves;
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    leaves.dims[axis] = (bricks.dims[axis] + leaf_bricks[axis] - 1) / leaf_bricks[axis];
    count *= static_cast<std::size_t>(leaves.dims[axis]);
  }
  leaves.min.assign(count, std::numeric_limits<float>::infinity());
  leaves.max.assign(count, -std::numeric_limits<float>::infinity());
  leaves.has_null.assign(count, 0);
  std::size_t brick = 0;
  for (std::int64_t a = 0; a < bricks.dims[0]; ++a) {
    for (std::int64_t b = 0; b < bricks.dims[1]; ++b) {
      const std::int64_t row = (a / leaf_bricks[0] * leaves.dims[1] + b / leaf_bricks[1]) * leaves.dims[2];
      for (std::int64_t c = 0; c < bricks.dims[2]; ++c, ++brick) {
        const auto leaf = static_cast<std::size_t>(row + c / leaf_bricks[2]);
        leaves.min[leaf] = std::min(leaves.min[leaf], bricks.min[brick]);
        leaves.max[leaf] = std::max(leaves.max[leaf], bricks.max[brick]);
        leaves.has_null[leaf] |= bricks.has_null[brick];
      }
    }
  }
  return leaves;
}

}  // namespace

survey::Index default_paper_cell(const survey::Index& volume_size) {
  survey::Index cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t bricks = (volume_size[axis] - 1 + kBrickCells[axis] - 1) / kBrickCells[axis];
    cell[axis] = kBrickCells[axis] * std::max<std::int64_t>(1, (bricks + kAlongAxis - 1) / kAlongAxis);
  }
  return cell;
}

Octree paper_octree(const Field& volume, const Bricks& bricks, const survey::Index& cell, int threads) {
  survey::Index leaf_bricks{};
  bool whole_bricks = true;
  for (int axis = 0; axis < 3; ++axis) {
    leaf_bricks[axis] = cell[axis] / kBrickCells[axis];
    whole_bricks = whole_bricks && cell[axis] > 0 && cell[axis] % kBrickCells[axis] == 0;
  }
  if (whole_bricks) return {joined(bricks, leaf_bricks).tables(), volume.volume_size, cell};
  return {leaf_ranges(volume, cell, threads).tables(), volume.volume_size, cell};
}

}  // namespace footwall::isosurface
