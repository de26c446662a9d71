// A survey of random values and random faces, the same on every rank: the generator's numbers are the
// standard's, the rest is integer arithmetic.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/extract/extract.h"
#include "engine/extract/face_numbers.h"

namespace footwall::extract {

struct RandomSurvey {
  RandomSurvey(const survey::Index& its_dims, unsigned seed) : dims(its_dims), random(seed) {
    for (std::int64_t n = 0; n < dims[0] * dims[1] * dims[2]; ++n) {
      const auto whole = static_cast<std::int32_t>(random() % 2000001) - 1000000;
      float value = static_cast<float>(whole) * 0.0009765625F;
      if (random() % 23 == 0) value *= 1e-30F;
      max_abs = std::max(max_abs, static_cast<double>(std::abs(value)));
      if (random() % 19 == 0) value = std::numeric_limits<float>::quiet_NaN();
      values.push_back(value);
    }
  }

  // Anywhere near the survey, some beyond its border, some far away; some are segments and points.
  survey::LatticeTriangle triangle() {
    survey::LatticeTriangle t{};
    const std::int64_t beyond = random() % 4 == 0 ? 5 : 0;
    const auto coordinate = [&](std::size_t axis) {
      const auto span = static_cast<std::uint64_t>((dims[axis] + 2 * beyond) * 256);
      return static_cast<std::int32_t>(static_cast<std::int64_t>(random() % span) - beyond * 256 - 128);
    };
    for (survey::LatticePoint& p : t) p = {coordinate(0), coordinate(1), coordinate(2)};
    if (random() % 13 == 0) t[2] = t[1];
    if (random() % 17 == 0) t[1] = t[2] = t[0];
    if (random() % 29 == 0) {
      for (survey::LatticePoint& p : t) p.i += 1 << 24;
    }
    return t;
  }

  ReadBox reader() const {
    return [this](const survey::Box& box, std::span<float> out) {
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
            out[n++] = values[static_cast<std::size_t>((i * dims[1] + j) * dims[2] + k)];
        }
      }
    };
  }

  survey::Index dims;
  std::mt19937_64 random;
  std::vector<float> values;
  double max_abs = 0;
};

inline std::uint64_t bits_of(double value) {
  return std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value);
}

inline bool same_bits(const FaceStatistics& a, const FaceStatistics& b) {
  return a.count == b.count && a.nulls == b.nulls && a.outside == b.outside &&
         std::all_of(kFaceNumbers.begin(), kFaceNumbers.end(), [&](const FaceNumber& each) {
           return bits_of(a.*each.member) == bits_of(b.*each.member);
         });
}

}  // namespace footwall::extract
