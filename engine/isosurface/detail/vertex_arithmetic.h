// The arithmetic of one vertex, in float32, as every scalar variant does it and every vectorized one must,
// bit for bit: no contraction, no approximate reciprocals, sums from left to right.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/isosurface/field.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface::detail {

inline constexpr float kLeastT = 1.0F / 1024;
inline constexpr float kMostT = 1 - kLeastT;
inline constexpr std::uint32_t kMagnitude = 0x7fffffff;  // a float without its sign
inline constexpr std::uint32_t kInfinity = 0x7f800000;

// Where between the values a (lower end) and b the isovalue lies; one of them is at or above it, the other is
// not. Where an infinite lower end leaves no number, the vertex stands at the other end, as it would in the
// limit.
inline float crossing(float a, float b, float isovalue) {
  const float t = (isovalue - a) / (b - a);
  const float most = t <= kMostT ? t : kMostT;
  return most >= kLeastT ? most : kLeastT;
}

// Twice the derivative of the field along one axis at a sample that is not null: a neighbour that is null or
// outside of the field counts as having the sample's own value, and what is left is doubled. `step` is the
// distance of the neighbours in `value`.
inline float twice_derivative(const float* value, std::int64_t index, std::int64_t size, std::int64_t step) {
  const bool below = index > 0 && value[-step] == value[-step];
  const bool above = index + 1 < size && value[step] == value[step];
  const float rise = (above ? value[step] : value[0]) - (below ? value[-step] : value[0]);
  return above != below ? rise + rise : rise;
}

// Twice the gradient at sample (i, j, k) of the field, counted from its own first one.
inline Point twice_gradient(const Field& field, std::int64_t i, std::int64_t j, std::int64_t k) {
  const std::int64_t row = field.size[2];
  const std::int64_t plane = field.size[1] * row;
  const float* const value = field.values.data() + i * plane + j * row + k;
  return {twice_derivative(value, i, field.size[0], plane), twice_derivative(value, j, field.size[1], row),
          twice_derivative(value, k, field.size[2], 1)};
}

// The factor, a power of two, that brings the largest of three magnitudes near 1, so that its square neither
// overflows nor vanishes; 0 where the largest is zero, infinite or no number.
inline float scale_of(const Point& v) {
  const std::uint32_t largest = std::max({std::bit_cast<std::uint32_t>(v.i) & kMagnitude,
                                          std::bit_cast<std::uint32_t>(v.j) & kMagnitude,
                                          std::bit_cast<std::uint32_t>(v.k) & kMagnitude});
  if (largest == 0 || largest >= kInfinity) return 0;
  const auto exponent = static_cast<std::int32_t>(largest >> 23);
  return std::bit_cast<float>(static_cast<std::uint32_t>(std::max(253 - exponent, 1)) << 23);
}

// The normal of a vertex at t between the gradients (or equal multiples of them) of an edge's lower and upper
// end. `falls`: the value falls along the edge, so that its direction, taken where the gradient has none, is
// the axis itself.
inline Point normal(const Point& lower, const Point& upper, float t, int axis, bool falls) {
  const Point g{lower.i + t * (upper.i - lower.i), lower.j + t * (upper.j - lower.j),
                lower.k + t * (upper.k - lower.k)};
  const float scale = scale_of(g);
  if (scale == 0) {
    const float along = falls ? 1.0F : -1.0F;
    return {axis == 0 ? along : 0, axis == 1 ? along : 0, axis == 2 ? along : 0};
  }
  const Point v{g.i * scale, g.j * scale, g.k * scale};
  const float inverse = -1 / std::sqrt(v.i * v.i + v.j * v.j + v.k * v.k);
  return {v.i * inverse, v.j * inverse, v.k * inverse};
}

// A centre vertex from the vertices of its loop, in the order of their edges; sums in double.
inline std::array<double, 3> sum_of(std::span<const std::uint32_t> loop, const Point* points) {
  std::array<double, 3> sum{};
  for (const std::uint32_t n : loop) {
    sum[0] += points[n].i;
    sum[1] += points[n].j;
    sum[2] += points[n].k;
  }
  return sum;
}
inline Point divided(const std::array<double, 3>& v, double by) {
  return {static_cast<float>(v[0] / by), static_cast<float>(v[1] / by), static_cast<float>(v[2] / by)};
}
inline Point centre_position(std::span<const std::uint32_t> loop, const Point* positions) {
  return divided(sum_of(loop, positions), static_cast<double>(loop.size()));
}
inline Point centre_normal(std::span<const std::uint32_t> loop, const Point* normals) {
  const auto sum = sum_of(loop, normals);
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  return length == 0 ? normals[loop.front()] : divided(sum, length);  // they cancel out: any will do
}

}  // namespace footwall::isosurface::detail
