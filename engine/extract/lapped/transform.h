// The lapped orthogonal transform, type I, of blocks of 8 values: each block's coefficients weigh 16 values,
// its own and the 4 on either side, so that no edges show between blocks after quantization. Orthonormal:
// the squares of the coefficients add up to those of the values.
// Based on: H. Malvar, D. Staelin, The LOT: transform coding without blocking effects, 1989 (seed 004,
// appendix E.4); differs in that bands stand in order of frequency, and that a signal is continued by its
// mirror image beyond its ends, so that 8 m values give 8 m coefficients.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace footwall::extract::lapped {

inline constexpr std::size_t kBands = 8;
inline constexpr std::size_t kReach = 4;                   // values taken from either neighbour
inline constexpr std::size_t kSquare = kBands * kBands;    // values of a two-dimensional block
inline constexpr std::size_t kTaps = kBands + 2 * kReach;  // values behind one coefficient

// The three angles of the butterflies' rotation. kStandard: (0.13, 0.16, 0.13) pi, best for values that
// change slowly. kTuned: (0.204, -0.315, -0.037) pi, best for band-limited traces along the sample axis.
enum class Angles : std::uint8_t { kStandard = 0, kTuned = 1 };

using Basis = std::array<std::array<double, kBands>, kTaps>;  // [value][band]
// Exact decimal constants and IEEE arithmetic only: the same on every machine.
const Basis& basis(Angles angles);

// coefficients[8 b + k] = sum over t of basis[t][k] values[8 b - 4 + t]. Both have 8 m elements, m >= 1; each
// coefficient is a sum in a fixed order, the same bits on every instruction set. The spans may not overlap.
void forward(std::span<const float> values, Angles angles, std::span<float> coefficients);
void inverse(std::span<const float> coefficients, Angles angles, std::span<float> values);

// A two-dimensional field of 8x8 blocks with holes: the blocks that exist, and for each the places of its
// neighbours in the list, or kNone, beyond which it is continued by its mirror image.
struct Tile {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t left = kNone;   // 8 columns before
  std::uint32_t right = kNone;  // 8 columns after
  std::uint32_t above = kNone;  // 8 rows before
  std::uint32_t below = kNone;  // 8 rows after
};

// values[64 n + 8 row + column] of tile n becomes coefficients[64 n + 8 (band of rows) + band of columns].
// across are the angles along a row, down those along a column; work has the size of both others.
void forward(std::span<const Tile> tiles, std::span<const float> values, Angles across, Angles down,
             std::span<float> work, std::span<float> coefficients);
void inverse(std::span<const Tile> tiles, std::span<const float> coefficients, Angles across, Angles down,
             std::span<float> work, std::span<float> values);

}  // namespace footwall::extract::lapped
