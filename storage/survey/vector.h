// A vector of three doubles, whatever its axes are: index space (inline, crossline, sample) or a scene.
#pragma once
#include <cmath>

namespace footwall::survey {

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator*(const Vector3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};

constexpr double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace footwall::survey
