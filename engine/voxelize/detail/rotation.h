// The rigid motion that lays a triangle into the plane z = 0 (seed 004, section 3.6.2 and appendix E.3.1),
// and its inverse for pixels.
#pragma once
#include <array>
#include <cstdint>

#include "engine/voxelize/rows.h"
#include "storage/survey/points.h"

namespace footwall::voxelize::detail {

using Vector = std::array<double, 3>;

// (v, s): a rotation by 2 acos(s) around v, of norm 1 (appendix E.2).
struct Quaternion {
  Vector v{0, 0, 0};
  double s = 1;
};

// The rotation around the unit vector `axis` by an angle in [0, pi] of which cosine and sine are known, or by
// its opposite.
Quaternion quaternion(const Vector& axis, double cosine, double sine, bool negative);
// First b, then a (E.22).
Quaternion operator*(const Quaternion& a, const Quaternion& b);
// E.18, row by row.
std::array<Vector, 3> matrix_of(const Quaternion& q);
Vector rotated(const Quaternion& q, const Vector& p);

// A triangle in the plane: v1 at pixel (0, 0), v3 at (x3, 0), v2 at (x2, y2) with 0 <= x2 <= x3, 0 <= y2; and
// where pixels lie in index space: pixel (x, y) at (x along_x + y along_y) + origin.
struct FlatTriangle {
  bool has_area = false;  // false: nothing else is set
  std::int64_t x2 = 0;
  std::int64_t y2 = 0;
  std::int64_t x3 = 0;
  Vector along_x{};
  Vector along_y{};
  Vector origin{};

  // In this order of operations everywhere: all loops must round alike.
  double position(std::size_t axis, double x, double y) const {
    return (along_x[axis] * x + along_y[axis] * y) + origin[axis];
  }
  Voxel voxel(std::int64_t x, std::int64_t y) const;
};

// (v1, v3) is the longest edge (the first of equal ones, in the order 01, 12, 20), v1 its end nearest the
// index origin (the first of equal ones).
FlatTriangle flatten(const survey::LatticeTriangle& triangle);

// The nearest integer, halves to even; |x| < 2^31.
std::int32_t nearest(double x);

}  // namespace footwall::voxelize::detail
