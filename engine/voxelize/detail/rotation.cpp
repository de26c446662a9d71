#include "engine/voxelize/detail/rotation.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/voxelize/detail/lines.h"
#include "engine/voxelize/detail/plane.h"

namespace footwall::voxelize::detail {
namespace {

Int128 squared_length(const Corner& a) {
  Int128 sum = 0;
  for (const std::int64_t x : a) sum += static_cast<Int128>(x) * x;
  return sum;
}

Corner minus(const Corner& a, const Corner& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// v1, v2, v3 of the seed.
Corners arranged(const Corners& p) {
  std::size_t edge = 0;
  for (std::size_t n = 1; n < 3; ++n) {
    if (squared_length(minus(p[(n + 1) % 3], p[n])) > squared_length(minus(p[(edge + 1) % 3], p[edge])))
      edge = n;
  }
  std::size_t first = edge;
  std::size_t last = (edge + 1) % 3;
  const std::size_t opposite = (edge + 2) % 3;
  if (squared_length(p[last]) < squared_length(p[first])) std::swap(first, last);
  return {p[first], p[opposite], p[last]};
}

Vector in_voxels(const Corner& p) {
  constexpr double kScale = 1.0 / survey::kLatticePerVoxel;
  return {static_cast<double>(p[0]) * kScale, static_cast<double>(p[1]) * kScale,
          static_cast<double>(p[2]) * kScale};
}

double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// Turns v3 around a horizontal axis into the plane z = 0 (3.36 to 3.39).
Quaternion lay_down(const Vector& v3) {
  const double across = length(v3[0], v3[1]);
  if (across == 0) return quaternion({0, 1, 0}, 0, 1, v3[2] < 0);
  const double whole = length(across, v3[2]);
  return quaternion({-v3[1] / across, v3[0] / across, 0}, across / whole, std::abs(v3[2]) / whole, v3[2] < 0);
}

// Turns v3 around z onto the x axis (3.42 to 3.44).
Quaternion align(const Vector& v3) {
  const double whole = length(v3[0], v3[1]);
  return quaternion({0, 0, 1}, v3[0] / whole, std::abs(v3[1]) / whole, v3[1] >= 0);
}

// Turns v2 around x into the plane z = 0, the shorter way (3.45 to 3.47).
Quaternion tip_over(const Vector& v2) {
  const double whole = length(v2[1], v2[2]);
  const bool same_side = (v2[1] >= 0 && v2[2] >= 0) || (v2[1] < 0 && v2[2] < 0);
  return quaternion({1, 0, 0}, std::abs(v2[1]) / whole, std::abs(v2[2]) / whole, same_side);
}

}  // namespace

std::int32_t nearest(double x) {
  // The sum's last bit stands for 1, so that the addition rounds.
  constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x + kRounder)));
}

Voxel FlatTriangle::voxel(std::int64_t x, std::int64_t y) const {
  const auto px = static_cast<double>(x);
  const auto py = static_cast<double>(y);
  return {nearest(position(0, px, py)), nearest(position(1, px, py)), nearest(position(2, px, py))};
}

Quaternion quaternion(const Vector& axis, double cosine, double sine, bool negative) {
  // Of half the angle; the smaller of the two from the other, where nothing cancels.
  double half_cosine = 0;
  double half_sine = 0;
  if (cosine >= 0) {
    half_cosine = std::sqrt((1 + cosine) / 2);
    half_sine = sine / (2 * half_cosine);
  } else {
    half_sine = std::sqrt((1 - cosine) / 2);
    half_cosine = sine / (2 * half_sine);
  }
  if (negative) half_sine = -half_sine;
  return {{axis[0] * half_sine, axis[1] * half_sine, axis[2] * half_sine}, half_cosine};
}

Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  const Vector& p = a.v;
  const Vector& q = b.v;
  return {{a.s * q[0] + b.s * p[0] + (p[1] * q[2] - p[2] * q[1]),
           a.s * q[1] + b.s * p[1] + (p[2] * q[0] - p[0] * q[2]),
           a.s * q[2] + b.s * p[2] + (p[0] * q[1] - p[1] * q[0])},
          a.s * b.s - (p[0] * q[0] + p[1] * q[1] + p[2] * q[2])};
}

std::array<Vector, 3> matrix_of(const Quaternion& q) {
  const double s = q.s;
  const double x = q.v[0];
  const double y = q.v[1];
  const double z = q.v[2];
  return {Vector{s * s + x * x - y * y - z * z, 2 * x * y - 2 * s * z, 2 * s * y + 2 * x * z},
          Vector{2 * s * z + 2 * x * y, s * s - x * x + y * y - z * z, 2 * y * z - 2 * s * x},
          Vector{2 * x * z - 2 * s * y, 2 * s * x + 2 * y * z, s * s - x * x - y * y + z * z}};
}

Vector rotated(const Quaternion& q, const Vector& p) {
  const auto m = matrix_of(q);
  Vector result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = m[axis][0] * p[0] + m[axis][1] * p[1] + m[axis][2] * p[2];
  return result;
}

FlatTriangle flatten(const survey::LatticeTriangle& triangle) {
  const Corners corners = corners_of(triangle);
  FlatTriangle flat;
  const auto normal = normal_of(corners);
  if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) return flat;
  const Corners v = arranged(corners);
  const Vector v2 = in_voxels(minus(v[1], v[0]));
  const Vector v3 = in_voxels(minus(v[2], v[0]));

  const Quaternion q1 = lay_down(v3);
  const Quaternion q2 = align(rotated(q1, v3));
  const Vector v2_aligned = rotated(q2, rotated(q1, v2));
  const Vector v3_aligned = rotated(q2, rotated(q1, v3));
  if (v2_aligned[1] == 0 && v2_aligned[2] == 0) return flat;
  const Quaternion q3 = tip_over(v2_aligned);
  const Vector v2_flat = rotated(q3, v2_aligned);
  const Quaternion q = q3 * (q2 * q1);
  const auto back = matrix_of({{-q.v[0], -q.v[1], -q.v[2]}, q.s});  // E.19

  flat.has_area = true;
  flat.x3 = nearest(v3_aligned[0]);
  flat.x2 = std::clamp<std::int64_t>(nearest(v2_flat[0]), 0, flat.x3);
  flat.y2 = nearest(std::abs(v2_flat[1]));
  // Where v2 came to lie below the x axis the plane is mirrored, and the pixels' way back too.
  const double side = v2_flat[1] < 0 ? -1 : 1;
  flat.origin = in_voxels(v[0]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    flat.along_x[axis] = back[axis][0];
    flat.along_y[axis] = side * back[axis][1];
  }
  return flat;
}

}  // namespace footwall::voxelize::detail
