// What one rank has sent to another and the other still keeps. Both ranks of a pair have such a ledger, enter
// the same transfers and take out the same bricks, so that they agree without a message.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/extract/cache/voxel_set.h"

namespace footwall::extract {

// Memory of a rank for one brick that was received: its values, its mask and its places in two directories.
inline constexpr std::int64_t kBytesPerBrick = kBrickVoxels * 4 + 64 + 64;

class PairLedger {
 public:
  // Of a pair whose sender owns voxels of `part`.
  explicit PairLedger(const survey::Box& part) : voxels_(part) {}

  // Enters a transfer. Times must not fall from call to call.
  void enter(const BrickList& list, std::int64_t time);
  // What of `wanted` is not there yet.
  BrickList missing(const BrickList& wanted) const;
  const Mask& in(const survey::Index& brick) const { return voxels_.in(brick); }
  std::int64_t bricks() const { return voxels_.bricks(); }
  std::int64_t voxels() const { return count_; }

  // Takes out bricks until at most `most` are left: those with the oldest last transfer first, the one with
  // the lower index of two alike. Returns the bricks taken out, with the time of each.
  struct Gone {
    survey::Index brick{};
    std::int64_t time = 0;
  };
  std::vector<Gone> keep(std::int64_t most);

 private:
  VoxelSet voxels_;
  std::vector<std::int64_t> times_;  // of the last transfer, by slot of voxels_
  std::int64_t count_ = 0;
};

}  // namespace footwall::extract
