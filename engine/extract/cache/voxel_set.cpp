#include "engine/extract/cache/voxel_set.h"

#include <algorithm>
#include <new>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::uint64_t kEveryByte = 0x0101010101010101u;
constexpr Mask kNone{};

// Bit b of byte a becomes bit a of byte b.
std::uint64_t transposed(std::uint64_t x) {
  std::uint64_t t = (x ^ (x >> 7)) & 0x00AA00AA00AA00AAu;
  x ^= t ^ (t << 7);
  t = (x ^ (x >> 14)) & 0x0000CCCC0000CCCCu;
  x ^= t ^ (t << 14);
  t = (x ^ (x >> 28)) & 0x00000000F0F0F0F0u;
  return x ^ t ^ (t << 28);
}

// Bit j becomes bit 0 of byte j.
std::uint64_t spread(std::uint64_t bits) {
  const std::uint64_t apart = bits * kEveryByte & 0x8040201008040201u;
  return (((apart & 0x7F7F7F7F7F7F7F7Fu) + 0x7F7F7F7F7F7F7F7Fu) | apart) >> 7 & kEveryByte;
}

// tile: bit b of byte a = the voxel a along the first and b along the second of the axes other than v, which
// is at `v`. First and second are in ascending order.
void add_plane(std::uint64_t tile, int v_axis, std::size_t v, Mask& mask) {
  if (v_axis == 0) {
    mask[v] |= tile;
  } else if (v_axis == 1) {
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= (tile >> (8 * i) & 0xFF) << (8 * v);
  } else {
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= spread(tile >> (8 * i) & 0xFF) << v;
  }
}

template <typename T>
T* zeros(std::int64_t count) {
  auto* memory =
      static_cast<T*>(std::calloc(static_cast<std::size_t>(std::max<std::int64_t>(count, 1)), sizeof(T)));
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// The mask moved by r voxels, 0 <= r < 8, along an axis: what stays in the brick and what goes to the next.
void shift(const Mask& mask, int axis, int r, Mask& stays, Mask& goes) {
  stays = {};
  goes = {};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (axis == 0) {
      const std::size_t to = i + static_cast<std::size_t>(r);
      (to < 8 ? stays[to] : goes[to - 8]) = mask[i];
    } else if (axis == 1) {
      stays[i] = mask[i] << (8 * r);
      goes[i] = r == 0 ? 0 : mask[i] >> (64 - 8 * r);
    } else {
      stays[i] = (mask[i] & kEveryByte * (0xFFu >> r)) << r;
      goes[i] = mask[i] >> (8 - r) & kEveryByte * ((1u << r) - 1);
    }
  }
}

}  // namespace

VoxelSet::VoxelSet(const survey::Box& part)
    : box_(part),
      directory_(zeros<std::uint32_t>(box_.count())),
      occupied_(zeros<std::uint64_t>((box_.count() + 63) / 64)) {}

Mask& VoxelSet::mask_at(std::int64_t place) {
  std::uint32_t& slot = directory_[static_cast<std::size_t>(place)];
  if (slot == 0) {
    masks_.emplace_back();
    places_.push_back(place);
    slot = static_cast<std::uint32_t>(masks_.size());
    occupied_[static_cast<std::size_t>(place / 64)] |= std::uint64_t{1} << (place % 64);
    lowest_ = std::min(lowest_, place / 64);
    highest_ = std::max(highest_, place / 64);
  }
  return masks_[slot - 1];
}

std::int64_t VoxelSet::count() const {
  std::int64_t sum = 0;
  for (const Mask& mask : masks_) sum += voxels_in(mask);
  return sum;
}

void VoxelSet::add(const voxelize::Row& row) {
  const bool turned = row.w_axis < row.u_axis;
  survey::Index brick{};
  brick[static_cast<std::size_t>(row.v_axis)] = row.v >> 3;
  list_tiles(row.lo, row.hi, static_cast<std::int32_t>(row.u0), tiles_);
  for (const RowTile& tile : tiles_) {
    brick[static_cast<std::size_t>(row.u_axis)] = tile.u;
    brick[static_cast<std::size_t>(row.w_axis)] = tile.w;
    add_plane(turned ? transposed(tile.bits) : tile.bits, row.v_axis, static_cast<std::size_t>(row.v & 7),
              mask_at(box_.place(brick)));
  }
}

void VoxelSet::add(const survey::Box& box) {
  const survey::Box inside = survey::intersection(box, part());
  if (inside.empty()) return;
  const survey::Index first{inside.lo[0] >> 3, inside.lo[1] >> 3, inside.lo[2] >> 3};
  const survey::Index last{(inside.hi[0] - 1) >> 3, (inside.hi[1] - 1) >> 3, (inside.hi[2] - 1) >> 3};
  for (std::int64_t i = first[0]; i <= last[0]; ++i) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      // Along the samples all bricks but the first and the last are alike.
      const Mask middle =
          mask_of({{inside.lo[0], inside.lo[1], 0}, {inside.hi[0], inside.hi[1], 8}}, {i, j, 0});
      for (std::int64_t k = first[2]; k <= last[2]; ++k) {
        const Mask mask = k == first[2] || k == last[2] ? mask_of(inside, {i, j, k}) : middle;
        Mask& into = mask_at(box_.place({i, j, k}));
        for (std::size_t w = 0; w < mask.size(); ++w) into[w] |= mask[w];
      }
    }
  }
}

void VoxelSet::add(const BrickMask& brick) {
  const survey::Index at{brick.brick[0], brick.brick[1], brick.brick[2]};
  if (!box_.contains(at)) return;
  const survey::Index first{at[0] * 8, at[1] * 8, at[2] * 8};
  const bool whole = part().contains(first) && part().contains({first[0] + 7, first[1] + 7, first[2] + 7});
  Mask mask = brick.mask;
  if (!whole) {
    const Mask inside = mask_of(part(), at);
    for (std::size_t w = 0; w < mask.size(); ++w) mask[w] &= inside[w];
  }
  if (none(mask)) return;
  Mask& into = mask_at(box_.place(at));
  for (std::size_t w = 0; w < mask.size(); ++w) into[w] |= mask[w];
}

void VoxelSet::add(const BrickList& list) {
  for (const BrickMask& brick : list) add(brick);
}

void VoxelSet::add(const VoxelSet& other) {
  other.for_each([&](const BrickMask& brick) { add(brick); });
}

void VoxelSet::add_shifted(const VoxelSet& other, int axis, std::int64_t by) {
  require(&other != this, "another set than this one");
  const std::int64_t bricks = by >> 3;
  const auto rest = static_cast<int>(by & 7);
  other.for_each([&](const BrickMask& from) {
    BrickMask stays = from;
    BrickMask goes = from;
    shift(from.mask, axis, rest, stays.mask, goes.mask);
    std::int32_t& at = stays.brick[static_cast<std::size_t>(axis)];
    at += static_cast<std::int32_t>(bricks);
    goes.brick[static_cast<std::size_t>(axis)] = at + 1;
    add(stays);
    if (rest != 0) add(goes);
  });
}

void VoxelSet::remove(const VoxelSet& other) {
  for (std::size_t n = places_.size(); n-- > 0;) {
    const survey::Index brick = box_.brick(places_[n]);
    const Mask& gone = other.in(brick);
    for (std::size_t w = 0; w < gone.size(); ++w) masks_[n][w] &= ~gone[w];
    if (none(masks_[n])) drop(brick);
  }
}

void VoxelSet::drop(const survey::Index& brick) {
  const std::int64_t slot = this->slot(brick);
  if (slot < 0) return;
  const auto n = static_cast<std::size_t>(slot);
  const std::int64_t place = places_[n];
  masks_[n] = masks_.back();
  places_[n] = places_.back();
  directory_[static_cast<std::size_t>(places_[n])] = static_cast<std::uint32_t>(n + 1);
  masks_.pop_back();
  places_.pop_back();
  directory_[static_cast<std::size_t>(place)] = 0;
  occupied_[static_cast<std::size_t>(place / 64)] &= ~(std::uint64_t{1} << (place % 64));
}

bool VoxelSet::contains(const survey::Index& voxel) const {
  const Mask& mask = in({voxel[0] >> 3, voxel[1] >> 3, voxel[2] >> 3});
  return (mask[static_cast<std::size_t>(voxel[0] & 7)] >> (8 * (voxel[1] & 7) + (voxel[2] & 7)) & 1) != 0;
}

const Mask& VoxelSet::in(const survey::Index& brick) const {
  const std::int64_t slot = this->slot(brick);
  return slot < 0 ? kNone : masks_[static_cast<std::size_t>(slot)];
}

std::int64_t VoxelSet::slot(const survey::Index& brick) const {
  if (!box_.contains(brick)) return -1;
  return std::int64_t{directory_[static_cast<std::size_t>(box_.place(brick))]} - 1;
}

BrickList VoxelSet::list() const {
  BrickList list;
  list.reserve(places_.size());
  for_each([&](const BrickMask& brick) { list.push_back(brick); });
  return list;
}

void VoxelSet::clear() {
  for (const std::int64_t place : places_) {
    directory_[static_cast<std::size_t>(place)] = 0;
    occupied_[static_cast<std::size_t>(place / 64)] = 0;
  }
  places_.clear();
  masks_.clear();
  lowest_ = std::numeric_limits<std::int64_t>::max();
  highest_ = -1;
}

namespace {

// Adds to every voxel those up to `far` voxels on in one direction along an axis; each round doubles how far.
void smear(VoxelSet& set, int axis, int direction, std::int64_t far, VoxelSet& room) {
  for (std::int64_t reached = 0; reached < far;) {
    const std::int64_t by = std::min(reached + 1, far - reached);
    room.clear();
    room.add(set);
    set.add_shifted(room, axis, direction * by);
    reached += by;
  }
}

}  // namespace

void grow(VoxelSet& set, std::int32_t reach, VoxelSet& room) {
  for (const int axis : {0, 1}) {
    smear(set, axis, 1, reach, room);
    smear(set, axis, -1, reach, room);
  }
}

void add_blocks(VoxelSet& set, std::int64_t side, VoxelSet& room) {
  const std::int64_t before = side / 2;
  for (const int axis : {0, 1, 2}) {
    smear(set, axis, 1, side - 1 - before, room);
    smear(set, axis, -1, before, room);
  }
}

}  // namespace footwall::extract
