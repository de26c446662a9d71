// Vectors and 4x4 matrices of the scene frame: metres east (x), north (y), up (z) from the survey's centre.
#pragma once
#include <array>

#include "storage/survey/vector.h"

namespace footwall::render {

using Vec3 = survey::Vector3;

struct Vec3f {
  float x = 0;
  float y = 0;
  float z = 0;

  Vec3f() = default;
  constexpr Vec3f(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Vec3f(const Vec3& v)
      : x(static_cast<float>(v.x)), y(static_cast<float>(v.y)), z(static_cast<float>(v.z)) {}
  explicit constexpr operator Vec3() const { return {x, y, z}; }
};

// Homogeneous clip coordinates, OpenGL's: inside where -w <= x, y, z <= w.
struct Vec4 {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 1;
};

// Row major; m * column vector.
using Matrix4 = std::array<double, 16>;

inline Vec4 transformed(const Matrix4& m, const Vec3& p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11], m[12] * p.x + m[13] * p.y + m[14] * p.z + m[15]};
}

// An axis-parallel box in the scene frame.
struct Bounds {
  Vec3 lo;
  Vec3 hi;
};

}  // namespace footwall::render
