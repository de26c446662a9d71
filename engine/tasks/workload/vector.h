// Vectors in index space, in voxels.
#pragma once
#include <cmath>

#include "storage/survey/points.h"

namespace footwall::tasks {

struct Vector {
  double i = 0;
  double j = 0;
  double k = 0;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.i + b.i, a.j + b.j, a.k + b.k}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.i - b.i, a.j - b.j, a.k - b.k}; }
  friend Vector operator*(const Vector& a, double s) { return {a.i * s, a.j * s, a.k * s}; }
};

inline double dot(const Vector& a, const Vector& b) {
  return a.i * b.i + a.j * b.j + a.k * b.k;
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.j * b.k - a.k * b.j, a.k * b.i - a.i * b.k, a.i * b.j - a.j * b.i};
}
inline double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}
inline Vector at(const survey::IndexPoint& p) {
  return {p.i, p.j, p.k};
}

}  // namespace footwall::tasks
