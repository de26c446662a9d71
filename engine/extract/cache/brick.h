// Bricks of 8 x 8 x 8 voxels, aligned to multiples of 8 in the survey, and sets of voxels inside one: what
// the cache, its records and the messages are counted in.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::extract {

inline constexpr std::int64_t kBrickSide = 8;
inline constexpr std::int64_t kBrickVoxels = 512;

// Which voxels of a brick: word i, bit 8 j + k stands for voxel (i, j, k) of the brick. The order of the
// bits, word after word, is that of the voxels' indices: inline, crossline, sample.
using Mask = std::array<std::uint64_t, 8>;

// Some voxels of one brick; `brick` is its index, the voxels' index divided by 8 on each axis.
struct BrickMask {
  std::array<std::int32_t, 3> brick{};
  Mask mask{};
};
// Bricks in ascending order of their index, none of them twice, none empty.
using BrickList = std::vector<BrickMask>;

inline std::int64_t voxels_in(const Mask& mask) {
  std::int64_t sum = 0;
  for (const std::uint64_t word : mask) sum += std::popcount(word);
  return sum;
}
inline std::int64_t voxels_in(const BrickList& bricks) {
  std::int64_t sum = 0;
  for (const BrickMask& each : bricks) sum += voxels_in(each.mask);
  return sum;
}
inline bool none(const Mask& mask) {
  std::uint64_t any = 0;
  for (const std::uint64_t word : mask) any |= word;
  return any == 0;
}

// A box of bricks and its places: numbers that ascend with the bricks' index, from 0.
class BrickBox {
 public:
  BrickBox() = default;
  // All bricks that hold voxels of `voxels`.
  explicit BrickBox(const survey::Box& voxels);

  const survey::Box& voxels() const { return voxels_; }
  std::int64_t count() const { return bricks_.count(); }
  bool contains(const survey::Index& brick) const { return bricks_.contains(brick); }
  std::int64_t place(const survey::Index& brick) const {
    return ((brick[0] - bricks_.lo[0]) * sizes_[1] + (brick[1] - bricks_.lo[1])) * sizes_[2] +
           (brick[2] - bricks_.lo[2]);
  }
  survey::Index brick(std::int64_t place) const {
    return {bricks_.lo[0] + place / (sizes_[1] * sizes_[2]), bricks_.lo[1] + place / sizes_[2] % sizes_[1],
            bricks_.lo[2] + place % sizes_[2]};
  }

 private:
  survey::Box voxels_;
  survey::Box bricks_;
  survey::Index sizes_{0, 0, 0};
};

// The voxels of `box` that lie in a brick.
Mask mask_of(const survey::Box& box, const survey::Index& brick);

}  // namespace footwall::extract
