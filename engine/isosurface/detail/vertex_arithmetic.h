// The arithmetic of one vertex, in float32, as every scalar variant does it and every vectorized one must, bit
// for bit: no contraction, no reciprocals, sums from left to right.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/isosurface/field.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface::detail {

inline constexpr float kLeastT = 1.0F / 1024;
inline constexpr float kMostT = 1 - kLeastT;

// Where between the values a (lower end) and b the isovalue lies; one of them is at or above it, the other is
// not. Of infinite values the quotient may be no number: that counts as the least.
inline float crossing(float a, float b, float isovalue) {
  const float t = (isovalue - a) / (b - a);
  return t >= kLeastT ? (t <= kMostT ? t : kMostT) : kLeastT;
}

// The derivative of the field along one axis at a sample that is not null. `step` is the distance of the
// neighbours in `values`.
inline float derivative(const float* value, std::int64_t index, std::int64_t size, std::int64_t step) {
  const bool below = index > 0 && value[-step] == value[-step];
  const bool above = index + 1 < size && value[step] == value[step];
  if (below && above) return (value[step] - value[-step]) * 0.5F;
  if (above) return value[step] - value[0];
  if (below) return value[0] - value[-step];
  return 0;
}

// At sample (i, j, k) of the field, counted from its own first one.
inline Point gradient(const Field& field, std::int64_t i, std::int64_t j, std::int64_t k) {
  const std::int64_t row = field.size[2], plane = field.size[1] * row;
  const float* const value = field.values.data() + i * plane + j * row + k;
  return {derivative(value, i, field.size[0], plane), derivative(value, j, field.size[1], row),
          derivative(value, k, field.size[2], 1)};
}

// The vector as a unit vector; `otherwise` where it has no direction.
inline Point unit(const Point& v, const Point& otherwise) {
  const float square = v.i * v.i + v.j * v.j + v.k * v.k;
  if (!(square > 0) || !(square < INFINITY)) return otherwise;
  const float length = std::sqrt(square);
  return {v.i / length, v.j / length, v.k / length};
}

// Of the vertex at t between the lower end's gradient and the upper end's. `falls`: the value falls along the
// edge.
inline Point normal(const Point& lower, const Point& upper, float t, int axis, bool falls) {
  const float way = falls ? 1.0F : -1.0F;
  const Point along{axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0};
  return unit({-(lower.i + t * (upper.i - lower.i)), -(lower.j + t * (upper.j - lower.j)),
               -(lower.k + t * (upper.k - lower.k))},
              along);
}

}  // namespace footwall::isosurface::detail
