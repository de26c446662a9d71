// How large each coefficient is expected to be, from those before it: a mean of the same band in the blocks
// so far, the same band of the blocks to the left and above, and the lower bands of its own block. Integers
// only, so that the decoder, which meets one coefficient after the other, and the encoder, which has them
// all, find the same.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/lapped/tokens.h"
#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {

inline constexpr std::int32_t kMostSeen = 255;    // larger magnitudes count as this one
inline constexpr std::int32_t kMemory = 8;        // blocks that a band's mean reaches back
inline constexpr std::int32_t kFirstGuess = 128;  // in sixteenths, before anything was seen

// How often a neighbour counts in a weighted mean; the blocks to the left and above count once.
inline constexpr std::int32_t kNext = 2;     // one band lower, on either axis
inline constexpr std::int32_t kFurther = 1;  // two lower on one axis, or one on both

// The weights of the neighbours within a block of Rows x 8 bands.
template <std::size_t Rows>
constexpr std::array<std::int32_t, Rows * kBands> own_weights() {
  std::array<std::int32_t, Rows * kBands> weights{};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const std::size_t row = k / kBands;
    const std::size_t column = k % kBands;
    if (column > 0) weights[k] += kNext;
    if (row > 0) weights[k] += kNext;
    if (column > 1) weights[k] += kFurther;
    if (row > 1) weights[k] += kFurther;
    if (row > 0 && column > 0) weights[k] += kFurther;
  }
  return weights;
}

// 65536 / weight, rounded up, for every weight a mean may have; 0 for weight 0.
constexpr std::int32_t reciprocal_of(std::int32_t weight) {
  return weight == 0 ? 0 : (65536 + weight - 1) / weight;
}

// Reciprocals for blocks of Rows x 8 bands: of the weights within the block, plus `further`.
template <std::size_t Rows>
using Reciprocals = std::array<std::array<std::int32_t, Rows * kBands>, kMemory + 3>;  // [further][band]
template <std::size_t Rows>
const Reciprocals<Rows>& reciprocals() {
  static constexpr Reciprocals<Rows> kTable = [] {
    Reciprocals<Rows> table{};
    for (std::size_t further = 0; further < table.size(); ++further) {
      for (std::size_t k = 0; k < Rows * kBands; ++k) {
        table[further][k] = reciprocal_of(own_weights<Rows>()[k] + static_cast<std::int32_t>(further));
      }
    }
    return table;
  }();
  return kTable;
}

// Magnitudes of a block with a border of zeros above and to the left, so that every band has neighbours.
template <std::size_t Rows>
struct Bordered {
  static constexpr std::size_t kBorder = 2;
  static constexpr std::size_t kStride = kBands + 8;
  static constexpr std::size_t place(std::size_t k) {
    return (k / kBands + kBorder) * kStride + k % kBands + kBorder;
  }
  alignas(64) std::array<std::int32_t, (Rows + kBorder) * kStride> value{};

  // Of neighbours times their weights.
  std::int32_t sum(std::size_t k) const {
    const std::int32_t* at = value.data() + place(k);
    return kNext * (at[-1] + *(at - kStride)) +
           kFurther * (at[-2] + *(at - 2 * kStride) + *(at - kStride - 1));
  }
};

// The mean magnitude of each band over the blocks so far, in sixteenths.
template <std::size_t Rows>
struct BandMeans {
  std::int32_t seen = 0;  // at most kMemory
  alignas(64) std::array<std::int32_t, Rows * kBands> mean{};

  void add(const Bordered<Rows>& block) {
    seen = std::min(seen + 1, kMemory);
    const std::int32_t reciprocal = reciprocal_of(seen);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] += ((block.value[block.place(k)] * 16 - mean[k]) * reciprocal) >> 16;
    }
  }
};

// The walk of the decoder, and what expected_magnitudes() must agree with: code(n, expected) is called for
// every coefficient in order and returns its magnitude. left and above give, for a block, the number of the
// block on that side, or Tile::kNone. `magnitudes` is room.
template <std::size_t Rows, class Left, class Above, class Code>
void walk(std::size_t blocks, Left&& left, Above&& above, std::vector<std::uint8_t>& magnitudes,
          Code&& code) {
  constexpr std::size_t kSize = Rows * kBands;
  magnitudes.resize(blocks * kSize);
  BandMeans<Rows> means;
  Bordered<Rows> own;
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<const std::uint8_t*, 2> sides{};
    std::size_t count = 0;
    for (const std::uint32_t side : {left(b), above(b)}) {
      if (side != Tile::kNone) sides[count++] = magnitudes.data() + side * kSize;
    }
    const auto further = static_cast<std::size_t>(means.seen) + count;
    for (std::size_t k = 0; k < kSize; ++k) {
      std::int32_t sum = own.sum(k);
      for (std::size_t side = 0; side < count; ++side) sum += sides[side][k];
      const std::int32_t reciprocal = reciprocals<Rows>()[further][k];
      const std::int32_t total = 16 * sum + means.seen * means.mean[k];
      const std::int32_t expected = reciprocal == 0 ? kFirstGuess : total * reciprocal >> 16;
      const auto magnitude = static_cast<std::int32_t>(
          std::min(code(b * kSize + k, static_cast<std::uint32_t>(expected)), std::uint32_t{kMostSeen}));
      own.value[own.place(k)] = magnitude;
      magnitudes[b * kSize + k] = static_cast<std::uint8_t>(magnitude);
    }
    means.add(own);
  }
}

// What walk() would expect for these coefficients, in their order, all at once. `magnitudes` is room.
void expected_magnitudes(std::span<const std::int32_t> line, std::vector<std::uint16_t>& expected);
void expected_magnitudes(std::span<const Tile> tiles, std::span<const std::int32_t> coefficients,
                         std::vector<std::int32_t>& magnitudes, std::vector<std::uint16_t>& expected);

}  // namespace footwall::extract::lapped
