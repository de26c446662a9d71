// 128-bit integers: products of two lattice differences and a position do not fit 64 bits.
#pragma once
#include <cstdint>

namespace footwall::voxelize::detail {

__extension__ typedef __int128 Int128;

// Largest integer not above numerator / denominator; denominator > 0.
template <class Integer>
Integer floor_div(Integer numerator, Integer denominator) {
  const Integer quotient = numerator / denominator;
  return quotient * denominator > numerator ? quotient - 1 : quotient;
}

inline Int128 magnitude(Int128 value) {
  return value < 0 ? -value : value;
}

// The number of bits of a value >= 0, e.g. 3 for 4..7.
inline int bits_of(std::uint64_t value) {
  return value == 0 ? 0 : 64 - __builtin_clzll(value);
}

}  // namespace footwall::voxelize::detail
