// Random numbers that are the same on every machine: the generator is the standard's, and no function of the
// C library's beyond the exactly rounded square root takes part.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "storage/survey/vector.h"

namespace footwall::tasks {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  // In [0, limit); limit > 0.
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(engine_() % limit); }
  // A direction, all alike: from a point in the ball, found by trying.
  survey::Vector3 direction() {
    for (;;) {
      const survey::Vector3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
      const double square = dot(v, v);
      if (square > 1e-6 && square <= 1) return v * (1 / std::sqrt(square));
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace footwall::tasks
