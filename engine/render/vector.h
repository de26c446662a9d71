// Vectors and 4x4 matrices of the scene frame: metres east (x), north (y), up (z) from the survey's centre.
#pragma once
#include <array>
#include <cmath>

namespace footwall::render {

struct Vec3f {
  float x = 0;
  float y = 0;
  float z = 0;
};

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  Vec3() = default;
  constexpr Vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Vec3(const Vec3f& v) : x(v.x), y(v.y), z(v.z) {}
  explicit operator Vec3f() const {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  }
  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};

constexpr double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

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
