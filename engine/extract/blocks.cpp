#include "engine/extract/blocks.h"

#include <algorithm>

namespace footwall::extract {

Blocks::Blocks(const comm::RankGrid& grid, int rank, const JobContext& job) {
  for (const survey::Box& box : grid.boxes(rank)) blocks_.emplace_back(box, grid.dims(), job);
}

const Block* Blocks::owning(const survey::Index& voxel) const {
  const auto found = std::find_if(blocks_.begin(), blocks_.end(),
                                  [&](const Block& block) { return block.own().contains(voxel); });
  return found == blocks_.end() ? nullptr : &*found;
}

const Block* Blocks::holding(const survey::Index& voxel) const {
  const auto found =
      std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& block) { return block.has(voxel); });
  return found == blocks_.end() ? nullptr : &*found;
}

}  // namespace footwall::extract
