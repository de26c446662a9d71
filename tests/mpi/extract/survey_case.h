// A survey in memory with faces in it, the same on every rank.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "engine/extract/extract.h"

namespace footwall::extract {

inline constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

struct Case {
  survey::Index dims;
  std::vector<float> values;  // [inline][crossline][sample]; NaN = null
  std::vector<Face> faces;
  double max_abs = 0;  // of the values, at least

  float at(const survey::Index& p) const {
    return values[static_cast<std::size_t>((p[0] * dims[1] + p[1]) * dims[2] + p[2])];
  }
  Input input() const { return {dims, max_abs, faces}; }
  ReadBox reader() const {
    return [this](const survey::Box& box, std::span<float> out) {
      ASSERT_EQ(static_cast<std::int64_t>(out.size()), box.count());
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) out[n++] = at({i, j, k});
        }
      }
    };
  }
};

// Values of very different size, with nulls: the generator's numbers are the standard's, the rest is integer
// arithmetic.
inline void fill_with_awkward_values(Case& made, std::mt19937_64& random) {
  for (std::int64_t n = 0; n < made.dims[0] * made.dims[1] * made.dims[2]; ++n) {
    const auto whole = static_cast<std::int32_t>(random() % 2000001) - 1000000;
    float value = static_cast<float>(whole) * 0.0009765625F;
    if (random() % 23 == 0) value *= 1e-30F;
    made.max_abs = std::max(made.max_abs, static_cast<double>(std::abs(value)));
    if (random() % 19 == 0) value = kNull;
    made.values.push_back(value);
  }
}

}  // namespace footwall::extract
