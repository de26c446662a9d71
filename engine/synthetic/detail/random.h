// Random numbers that are a function of a counter alone, so that any voxel can be made without the others.
#pragma once
#include <cstdint>

#include "storage/base/splitmix64.h"

namespace footwall::synthetic::detail {

// A stream of draws; streams of different seeds or purposes have nothing to do with each other.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t purpose)
      : numbers_(mixed(mixed(seed + kGolden) + purpose * kGolden)) {}

  // In [low, high), in steps of 2^-53 of the range.
  double between(double low, double high) { return low + (high - low) * numbers_.unit(); }
  double either_sign(double low, double high) {
    const double size = between(low, high);
    return between(0, 1) < 0.5 ? -size : size;
  }

 private:
  SplitMix64 numbers_;
};

}  // namespace footwall::synthetic::detail
