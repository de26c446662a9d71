// The encoder's way: all magnitudes of a block are there, so its bands are worked on side by side. Plain
// loops over integers, compiled once for each instruction set.
#include "engine/extract/lapped/expected_magnitude.h"

#include "storage/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/lapped/expected_magnitude.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::lapped::HWY_NAMESPACE {

// magnitudes: room for two blocks of a line, or all blocks of a field.
template <std::size_t Rows>
struct Block {
  static constexpr std::size_t kSize = Rows * kBands;

  static void expect(const std::int32_t* HWY_RESTRICT coefficients, const std::int32_t* left,
                     const std::int32_t* above, BandMeans<Rows>& means, Bordered<Rows>& own,
                     std::int32_t* HWY_RESTRICT magnitudes, std::uint16_t* HWY_RESTRICT expected) {
    for (std::size_t k = 0; k < kSize; ++k) {
      const std::int32_t value = coefficients[k];
      const std::int32_t size = value < 0 ? -value : value;
      magnitudes[k] = size < kMostSeen ? size : kMostSeen;
    }
    for (std::size_t row = 0; row < Rows; ++row) {
      hwy::CopyBytes<kBands * sizeof(std::int32_t)>(magnitudes + row * kBands,
                                                    own.value.data() + own.place(row * kBands));
    }
    const std::size_t further =
        static_cast<std::size_t>(means.seen) + (left != nullptr ? 1 : 0) + (above != nullptr ? 1 : 0);
    const std::int32_t* reciprocal = reciprocals<Rows>()[further].data();
    std::int32_t sum[kSize];
    for (std::size_t row = 0; row < Rows; ++row) {
      constexpr std::size_t kStride = Bordered<Rows>::kStride;
      const std::int32_t* at = own.value.data() + own.place(row * kBands);
      for (std::size_t c = 0; c < kBands; ++c) {
        const std::int32_t next = at[c - 1] + at[c - kStride];
        sum[row * kBands + c] =
            kNext * next + kFurther * (at[c - 2] + at[c - 2 * kStride] + at[c - kStride - 1]);
      }
    }
    if (left != nullptr) {
      for (std::size_t k = 0; k < kSize; ++k) sum[k] += left[k];
    }
    if (above != nullptr) {
      for (std::size_t k = 0; k < kSize; ++k) sum[k] += above[k];
    }
    const std::int32_t weight = means.seen;
    for (std::size_t k = 0; k < kSize; ++k) {
      const std::int32_t total = 16 * sum[k] + weight * means.mean[k];
      expected[k] = static_cast<std::uint16_t>(total * reciprocal[k] >> 16);
    }
    if (reciprocal[0] == 0) expected[0] = kFirstGuess;
    means.seen = weight < kMemory ? weight + 1 : kMemory;
    const std::int32_t share = reciprocal_of(means.seen);
    for (std::size_t k = 0; k < kSize; ++k) {
      means.mean[k] += ((magnitudes[k] * 16 - means.mean[k]) * share) >> 16;
    }
  }
};

void expect_line(const std::int32_t* HWY_RESTRICT line, std::size_t blocks,
                 std::uint16_t* HWY_RESTRICT expected) {
  BandMeans<1> means;
  Bordered<1> own;
  std::int32_t magnitudes[2][kBands];
  for (std::size_t b = 0; b < blocks; ++b) {
    Block<1>::expect(line + b * kBands, b > 0 ? magnitudes[(b + 1) % 2] : nullptr, nullptr, means, own,
                     magnitudes[b % 2], expected + b * kBands);
  }
}

void expect_tiles(const Tile* tiles, std::size_t count, const std::int32_t* HWY_RESTRICT coefficients,
                  std::int32_t* magnitudes, std::uint16_t* HWY_RESTRICT expected) {
  BandMeans<kBands> means;
  Bordered<kBands> own;
  const auto tile = [&](std::uint32_t n) { return n == Tile::kNone ? nullptr : magnitudes + n * kSquare; };
  for (std::size_t n = 0; n < count; ++n) {
    Block<kBands>::expect(coefficients + n * kSquare, tile(tiles[n].left), tile(tiles[n].above), means, own,
                          magnitudes + n * kSquare, expected + n * kSquare);
  }
}

}  // namespace footwall::extract::lapped::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract::lapped {

HWY_EXPORT(expect_line);
HWY_EXPORT(expect_tiles);

void expected_magnitudes(std::span<const std::int32_t> line, std::vector<std::uint16_t>& expected) {
  require(line.size() % kBands == 0, "whole blocks of coefficients");
  expected.resize(line.size());
  HWY_DYNAMIC_DISPATCH(expect_line)(line.data(), line.size() / kBands, expected.data());
}

void expected_magnitudes(std::span<const Tile> tiles, std::span<const std::int32_t> coefficients,
                         std::vector<std::int32_t>& magnitudes, std::vector<std::uint16_t>& expected) {
  require(coefficients.size() == tiles.size() * kSquare, "64 coefficients of every tile");
  expected.resize(coefficients.size());
  magnitudes.resize(coefficients.size());
  HWY_DYNAMIC_DISPATCH(expect_tiles)
  (tiles.data(), tiles.size(), coefficients.data(), magnitudes.data(), expected.data());
}

}  // namespace footwall::extract::lapped
#endif
