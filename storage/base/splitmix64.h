// Random numbers that are alike on every machine, which the standard library's distributions are not.
// Based on: Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014 (variant 13 of
// Stafford).
#pragma once
#include <cstdint>

namespace footwall {

// A bijection of 64 bits in which every input bit reaches every output bit.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

inline constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() { return mixed(state_ += kGolden); }
  // In [0, 1), in steps of 2^-53.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace footwall
