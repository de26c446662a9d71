#include "engine/isosurface/tables/shape.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/isosurface/tables/cell.h"

namespace footwall::isosurface::tables {
namespace {

constexpr double kTiny = 1e-9;

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Corners = std::array<Vector, 3>;

Vector normal(const Corners& t) {
  return cross(minus(t[1], t[0]), minus(t[2], t[0]));
}

// Whether the line from p to q passes through the inside of the triangle; touching is not passing.
bool pierces(const Vector& p, const Vector& q, const Corners& t) {
  const Vector n = normal(t);
  const double from = dot(n, minus(p, t[0]));
  const double to = dot(n, minus(q, t[0]));
  if (std::abs(from) < kTiny || std::abs(to) < kTiny || (from > 0) == (to > 0)) return false;
  Vector at{};
  for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = p[axis] + from / (from - to) * (q[axis] - p[axis]);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vector side = minus(t[(corner + 1) % 3], t[corner]);
    if (dot(n, cross(side, minus(at, t[corner]))) < kTiny) return false;
  }
  return true;
}

int common_vertices(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return static_cast<int>(std::count_if(
      a.begin(), a.end(), [&](int vertex) { return std::find(b.begin(), b.end(), vertex) != b.end(); }));
}

bool get_along(const Corners& a, const Corners& b, int common) {
  const Vector n = normal(a);
  const Vector m = normal(b);
  const bool folded = dot(n, m) < -0.999 * std::sqrt(dot(n, n) * dot(m, m));
  if (common == 2 && folded) return false;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    if (pierces(a[corner], a[(corner + 1) % 3], b) || pierces(b[corner], b[(corner + 1) % 3], a))
      return false;
  }
  return true;
}

}  // namespace

Places places_of(unsigned signs, std::optional<bool> joins_inside) {
  Places places{};
  for (int edge = 0; edge < 12; ++edge) {
    const int low = lower_corner(edge);
    for (int axis = 0; axis < 3; ++axis) places[edge][axis] = low >> axis & 1;
    double& along = places[edge][axis_of(edge)];
    along = 0.5;
    if (joins_inside) along = is_inside(signs, low) == *joins_inside ? 2.0 / 3 : 1.0 / 3;
  }
  return places;
}

unsigned vertices_beside_centre(const Triangles& triangles) {
  unsigned beside = 0;
  for (const std::array<int, 3>& triangle : triangles) {
    if (std::find(triangle.begin(), triangle.end(), kCentreVertex) == triangle.end()) continue;
    for (const int vertex : triangle) {
      if (vertex != kCentreVertex) beside |= 1U << vertex;
    }
  }
  return beside;
}

Places with_centre(Places places, unsigned beside) {
  places[kCentreVertex] = {};
  for (int edge = 0; edge < 12; ++edge) {
    if ((beside >> edge & 1U) == 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      places[kCentreVertex][axis] += places[edge][axis] / std::popcount(beside);
  }
  return places;
}

double area(const Triangles& triangles, const Places& places) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vector n = normal({places[a], places[b], places[c]});
    sum += std::sqrt(dot(n, n)) / 2;
  }
  return sum;
}

bool is_embedded(const Triangles& triangles, const Places& places) {
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : triangles) corners.push_back({places[a], places[b], places[c]});
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Vector up = normal(corners[n]);
    if (dot(up, up) < kTiny) return false;
    for (std::size_t m = 0; m < n; ++m) {
      if (!get_along(corners[n], corners[m], common_vertices(triangles[n], triangles[m]))) return false;
    }
  }
  return true;
}

}  // namespace footwall::isosurface::tables
