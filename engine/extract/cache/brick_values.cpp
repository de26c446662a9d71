#include "engine/extract/cache/brick_values.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

survey::Index first_of(const BrickMask& each) {
  return {std::int64_t{each.brick[0]} * 8, std::int64_t{each.brick[1]} * 8, std::int64_t{each.brick[2]} * 8};
}

// The places in a block of the 64 voxels of one inline of a brick, from that of bit 0.
std::array<std::int64_t, 64> places_of(const Block& block) {
  std::array<std::int64_t, 64> places{};
  for (std::size_t bit = 0; bit < places.size(); ++bit) {
    places[bit] = static_cast<std::int64_t>(bit / 8) * block.strides()[1] +
                  static_cast<std::int64_t>(bit % 8) * block.strides()[2];
  }
  return places;
}

}  // namespace

void gather(const Blocks& blocks, const BrickList& list, std::span<float> values) {
  if (list.empty()) return;
  const std::span<const Block> all = blocks.all();
  require(!all.empty(), "values of own voxels");
  std::array<std::int64_t, 64> places = places_of(all.front());
  const Block* block = &all.front();
  float* out = values.data();
  for (const BrickMask& each : list) {
    const survey::Index first = first_of(each);
    const survey::Index last{first[0] + 7, first[1] + 7, std::min(first[2] + 7, block->own().hi[2] - 1)};
    if (all.size() > 1 && !(block->own().contains(first) && block->own().contains(last))) {
      const auto whole = std::find_if(all.begin(), all.end(), [&](const Block& b) {
        return b.own().contains(first) && b.own().contains(last);
      });
      if (whole == all.end()) {  // of several pillars, perhaps
        for (std::size_t i = 0; i < each.mask.size(); ++i) {
          for (std::uint64_t word = each.mask[i]; word != 0; word &= word - 1) {
            const int bit = std::countr_zero(word);
            const survey::Index voxel{first[0] + static_cast<std::int64_t>(i), first[1] + bit / 8,
                                      first[2] + bit % 8};
            const Block* owner = blocks.owning(voxel);
            require(owner != nullptr, "a voxel of this rank");
            *out++ = owner->data()[owner->offset(voxel)];
          }
        }
        continue;
      }
      block = &*whole;
      places = places_of(*block);
    }
    const float* data = block->data();
    std::int64_t at = block->offset(first);
    for (std::size_t i = 0; i < each.mask.size(); ++i, at += block->strides()[0]) {
      for (std::uint64_t word = each.mask[i]; word != 0; word &= word - 1) {
        *out++ = data[at + places[static_cast<std::size_t>(std::countr_zero(word))]];
      }
    }
  }
  require(out == values.data() + values.size(), "room for every voxel of the list");
}

void coordinates_of(const BrickList& list, std::span<Coordinates> coordinates) {
  Coordinates* out = coordinates.data();
  for (const BrickMask& each : list) {
    const Coordinates first{each.brick[0] * 8, each.brick[1] * 8, each.brick[2] * 8};
    for (std::size_t i = 0; i < each.mask.size(); ++i) {
      for (std::uint64_t word = each.mask[i]; word != 0; word &= word - 1) {
        const int bit = std::countr_zero(word);
        *out++ = {first[0] + static_cast<std::int32_t>(i), first[1] + bit / 8, first[2] + bit % 8};
      }
    }
  }
  require(out == coordinates.data() + coordinates.size(), "room for every voxel of the list");
}

BrickList bricks_of(std::span<const Coordinates> coordinates) {
  BrickList list;
  const Coordinates* previous = nullptr;
  for (const Coordinates& p : coordinates) {
    const std::array<std::int32_t, 3> brick{p[0] >> 3, p[1] >> 3, p[2] >> 3};
    if (list.empty() || list.back().brick != brick) {
      require(list.empty() || list.back().brick < brick, "voxels in the order of their bricks");
      list.push_back({brick, {}});
      previous = nullptr;
    }
    require(previous == nullptr || *previous < p, "the voxels of a brick in order, each once");
    list.back().mask[static_cast<std::size_t>(p[0] & 7)] |= std::uint64_t{1} << (8 * (p[1] & 7) + (p[2] & 7));
    previous = &p;
  }
  return list;
}

}  // namespace footwall::extract
