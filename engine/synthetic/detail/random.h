// Random numbers that are a function of a counter alone, so that any voxel can be made without the others.
#pragma once
#include <cstdint>

namespace footwall::synthetic::detail {

// A bijection of 64 bits in which every input bit reaches every output bit.
// Based on: Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014 (variant 13 of
// Stafford).
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

inline constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

// A stream of draws; streams of different seeds or purposes have nothing to do with each other.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t purpose)
      : state_(mixed(mixed(seed + kGolden) + purpose * kGolden)) {}

  // In [low, high), in steps of 2^-53 of the range.
  double between(double low, double high) {
    state_ += kGolden;
    return low + (high - low) * (static_cast<double>(mixed(state_) >> 11) * 0x1p-53);
  }
  double either_sign(double low, double high) {
    const double size = between(low, high);
    return between(0, 1) < 0.5 ? -size : size;
  }

 private:
  std::uint64_t state_;
};

}  // namespace footwall::synthetic::detail
