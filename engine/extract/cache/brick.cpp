#include "engine/extract/cache/brick.h"

namespace footwall::extract {
namespace {

// Bits [from, to) of a byte, both limited to 0..8.
std::uint64_t bits_between(std::int64_t from, std::int64_t to) {
  from = std::clamp<std::int64_t>(from, 0, kBrickSide);
  to = std::clamp<std::int64_t>(to, from, kBrickSide);
  return (std::uint64_t{1} << to) - (std::uint64_t{1} << from);
}

}  // namespace

BrickBox::BrickBox(const survey::Box& voxels) : voxels_(voxels) {
  if (voxels.empty()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bricks_.lo[axis] = voxels.lo[axis] >> 3;
    bricks_.hi[axis] = ((voxels.hi[axis] - 1) >> 3) + 1;
    sizes_[axis] = bricks_.hi[axis] - bricks_.lo[axis];
  }
}

Mask mask_of(const survey::Box& box, const survey::Index& brick) {
  std::array<std::uint64_t, 3> lines{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t first = brick[axis] * kBrickSide;
    lines[axis] = bits_between(box.lo[axis] - first, box.hi[axis] - first);
  }
  std::uint64_t plane = 0;
  for (int j = 0; j < kBrickSide; ++j) {
    if ((lines[1] >> j & 1) != 0) plane |= lines[2] << (8 * j);
  }
  Mask mask{};
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = (lines[0] >> i & 1) != 0 ? plane : 0;
  return mask;
}

}  // namespace footwall::extract
