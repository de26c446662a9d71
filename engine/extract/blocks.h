// A rank's own part of the survey in memory: one block with a halo for each pillar of the rank.
#pragma once
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/block.h"

namespace footwall::extract {

class Blocks {
 public:
  // All NaN at first; no block at all for a rank without voxels. Throws std::bad_alloc, kCancelled.
  Blocks(const comm::RankGrid& grid, int rank, const JobContext& job = {});

  std::span<const Block> all() const { return blocks_; }
  std::span<Block> all() { return blocks_; }
  bool empty() const { return blocks_.empty(); }

  // The block that owns a voxel; null for a voxel of another rank, or outside the survey.
  const Block* owning(const survey::Index& voxel) const;
  // The block that owns a voxel or has it in its halo; null where there is none.
  const Block* holding(const survey::Index& voxel) const;

 private:
  std::vector<Block> blocks_;
};

}  // namespace footwall::extract
