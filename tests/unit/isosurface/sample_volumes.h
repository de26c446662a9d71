// Small volumes for the tests of surfaces.
#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "engine/isosurface/field.h"

namespace footwall::isosurface {

inline constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

struct SampleVolume {
  std::vector<float> values;
  survey::Index size;
  Field field() const { return {values, size, {0, 0, 0}, size}; }
};

template <class Value>
SampleVolume sampled(const survey::Index& size, Value&& value) {
  SampleVolume made{{}, size};
  for (std::int64_t i = 0; i < size[0]; ++i) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t k = 0; k < size[2]; ++k) made.values.push_back(static_cast<float>(value(i, j, k)));
    }
  }
  return made;
}

inline SampleVolume random_volume(const survey::Index& size, unsigned seed, double null_share = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  std::bernoulli_distribution null(null_share);
  return sampled(size, [&](auto...) { return null(random) ? kNull : value(random); });
}

// At or above 0 inside a ball.
inline double ball(double i, double j, double k, double radius) {
  return radius - std::sqrt(i * i + j * j + k * k);
}
inline SampleVolume ball_volume(const survey::Index& size, double radius) {
  return sampled(size, [&](auto i, auto j, auto k) {
    return ball(static_cast<double>(i) - (static_cast<double>(size[0]) - 1) / 2 - 0.1,
                static_cast<double>(j) - (static_cast<double>(size[1]) - 1) / 2 + 0.2,
                static_cast<double>(k) - (static_cast<double>(size[2]) - 1) / 2 - 0.3, radius);
  });
}

// At or above 0 inside a ring around the k axis.
inline SampleVolume ring_volume(double radius, double thickness) {
  const auto half = static_cast<std::int64_t>(radius + thickness) + 3;
  const std::int64_t flat = static_cast<std::int64_t>(thickness) + 3;
  return sampled({2 * half + 1, 2 * half + 1, 2 * flat + 1}, [=](auto i, auto j, auto k) {
    const double around = std::hypot(static_cast<double>(i - half), static_cast<double>(j - half)) - radius;
    return thickness - std::hypot(around, static_cast<double>(k - flat));
  });
}

// A part of a volume as a field of its own, with the samples of `box`.
struct SamplePart {
  std::vector<float> values;
  Field field;
};
inline SamplePart part_of(const SampleVolume& volume, const survey::Box& box) {
  SamplePart part;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
        part.values.push_back(
            volume.values[static_cast<std::size_t>((i * volume.size[1] + j) * volume.size[2] + k)]);
      }
    }
  }
  part.field = {part.values, {box.size(0), box.size(1), box.size(2)}, box.lo, volume.size};
  return part;
}

}  // namespace footwall::isosurface
