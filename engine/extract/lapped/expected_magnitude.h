// How large each coefficient is expected to be from those before it: one walk for encoder and decoder alike,
// in integers.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/lapped/tokens.h"
#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {

inline constexpr std::uint32_t kMostSeen = 255;    // larger magnitudes count as this one
inline constexpr std::uint32_t kMemory = 8;        // blocks that a band's mean reaches back
inline constexpr std::uint32_t kFirstGuess = 128;  // in sixteenths, before anything was seen
inline constexpr std::uint32_t kMostWeight = kMemory + 9 + 2;

// 65536 / n, rounded up; so that x * kReciprocal[n] >> 16 is about x / n.
inline constexpr auto kReciprocal = [] {
  std::array<std::uint32_t, kMostWeight + 1> table{};
  for (std::uint32_t n = 1; n < table.size(); ++n) table[n] = (65536 + n - 1) / n;
  return table;
}();

// The mean magnitude of each band over the blocks so far, in sixteenths.
template <std::size_t Bands>
class BandMeans {
 public:
  std::uint32_t weight() const { return std::min(seen_, kMemory); }
  std::uint32_t operator[](std::size_t band) const { return static_cast<std::uint32_t>(mean_[band]); }
  void add(const std::uint8_t* block) {
    ++seen_;
    const auto reciprocal = static_cast<std::int32_t>(kReciprocal[weight()]);
    for (std::size_t k = 0; k < Bands; ++k) {
      mean_[k] += ((block[k] * 16 - mean_[k]) * reciprocal) >> 16;
    }
  }

 private:
  std::uint32_t seen_ = 0;
  std::array<std::int32_t, Bands> mean_{};
};

struct Estimate {
  std::uint32_t sum = 0;  // of weight * magnitude, in sixteenths
  std::uint32_t weight = 0;
  void add(std::uint32_t times, std::uint32_t magnitude) {
    sum += 16 * times * magnitude;
    weight += times;
  }
  std::uint32_t expected() const {
    return weight == 0 ? kFirstGuess : std::min(sum * kReciprocal[weight] >> 16, kMostExpected);
  }
};

// code(n, class) is called for every coefficient in order, and returns its magnitude. `magnitudes` is room.
template <class Code>
void walk_line(std::size_t blocks, std::vector<std::uint8_t>& magnitudes, Code&& code) {
  magnitudes.resize(2 * kBands);
  std::uint8_t* before = magnitudes.data();
  std::uint8_t* block = before + kBands;
  BandMeans<kBands> means;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint32_t weight = means.weight();
    for (std::size_t k = 0; k < kBands; ++k) {
      Estimate estimate{means[k] * weight, weight};
      if (b > 0) estimate.add(1, before[k]);
      if (k > 0) estimate.add(2, block[k - 1]);
      if (k > 1) estimate.add(1, block[k - 2]);
      const std::uint32_t magnitude = code(b * kBands + k, class_of(estimate.expected()));
      block[k] = static_cast<std::uint8_t>(std::min(magnitude, kMostSeen));
    }
    means.add(block);
    std::swap(before, block);
  }
}

template <class Code>
void walk_tiles(std::span<const Tile> tiles, std::vector<std::uint8_t>& magnitudes, Code&& code) {
  magnitudes.resize(tiles.size() * kSquare);
  BandMeans<kSquare> means;
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    const std::uint32_t weight = means.weight();
    const auto tile = [&](std::uint32_t index) -> const std::uint8_t* {
      return index == Tile::kNone ? nullptr : magnitudes.data() + index * kSquare;
    };
    const std::uint8_t* left = tile(tiles[n].left);
    const std::uint8_t* above = tile(tiles[n].above);
    std::uint8_t* own = magnitudes.data() + n * kSquare;
    for (std::size_t k = 0; k < kSquare; ++k) {
      const std::size_t row = k / kBands;
      const std::size_t column = k % kBands;
      Estimate estimate{means[k] * weight, weight};
      if (left != nullptr) estimate.add(1, left[k]);
      if (above != nullptr) estimate.add(1, above[k]);
      if (column > 0) estimate.add(2, own[k - 1]);
      if (row > 0) estimate.add(2, own[k - kBands]);
      if (column > 0 && row > 0) estimate.add(1, own[k - kBands - 1]);
      if (column > 1) estimate.add(1, own[k - 2]);
      if (row > 1) estimate.add(1, own[k - 2 * kBands]);
      const std::uint32_t magnitude = code(n * kSquare + k, class_of(estimate.expected()));
      own[k] = static_cast<std::uint8_t>(std::min(magnitude, kMostSeen));
    }
    means.add(own);
  }
}

}  // namespace footwall::extract::lapped
