// The weights of resampling along one axis; see resample_volume.h for the method.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/tasks/resample_volume.h"

namespace footwall::tasks {

// For every new index the old samples that it is made of.
class Taps {
 public:
  struct View {
    std::int64_t first = 0;  // old index of the first tap
    std::int64_t count = 0;
    std::int64_t nearest = 0;  // the tap nearest to the new position; the lower one of two
    const double* weights = nullptr;
    const double* hat = nullptr;  // not negative; for what is near nulls
  };
  explicit Taps(const AxisPlace& place);

  View at(std::int64_t index) const;
  // The old samples that new ones in [lo, hi) need.
  std::int64_t first_of(std::int64_t lo, std::int64_t hi) const;
  std::int64_t end_of(std::int64_t lo, std::int64_t hi) const;

 private:
  struct Entry {
    std::int64_t first, count, nearest, at;
  };
  std::vector<Entry> entries_;
  std::vector<double> weights_;
  std::vector<double> hats_;
};

// One new sample of old ones at from[0], from[stride] ...
float combined(const Taps::View& taps, const float* from, std::int64_t stride);
// The same for `count` samples side by side: rows[t][n] is tap t of sample n.
void combine(const Taps::View& taps, std::span<const float* const> rows, std::int64_t count, float* to);

}  // namespace footwall::tasks
