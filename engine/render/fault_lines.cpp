#include "engine/render/fault_lines.h"

#include <algorithm>
#include <cmath>

namespace footwall::render {
namespace {

double coordinate(const survey::IndexPoint& p, int axis) {
  return axis == 0 ? p.i : axis == 1 ? p.j : p.k;
}

survey::IndexPoint between(const survey::IndexPoint& a, const survey::IndexPoint& b, double share) {
  return {a.i + (b.i - a.i) * share, a.j + (b.j - a.j) * share, a.k + (b.k - a.k) * share};
}

}  // namespace

std::vector<Vec3> border_of(std::span<const Vec3> vertices, std::span<const TriangleIndices> triangles) {
  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(3 * triangles.size());
  for (const TriangleIndices& t : triangles) {
    for (std::size_t n = 0; n < 3; ++n) {
      const auto [low, high] = std::minmax(t[n], t[(n + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Vec3> border;
  for (std::size_t n = 0; n < edges.size();) {
    std::size_t after = n + 1;
    while (after < edges.size() && edges[after] == edges[n]) ++after;
    if (after == n + 1) {
      for (const std::int32_t v : edges[n]) border.push_back(vertices[static_cast<std::size_t>(v)]);
    }
    n = after;
  }
  return border;
}

std::vector<Vec3> cut_of(const SceneFrame& frame, std::span<const survey::IndexPoint> vertices,
                         std::span<const TriangleIndices> triangles, int axis, double at) {
  std::vector<Vec3> cut;
  for (const TriangleIndices& t : triangles) {
    std::array<Vec3, 3> points;
    std::size_t count = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const survey::IndexPoint& a = vertices[static_cast<std::size_t>(t[n])];
      const survey::IndexPoint& b = vertices[static_cast<std::size_t>(t[(n + 1) % 3])];
      const double da = coordinate(a, axis) - at;
      const double db = coordinate(b, axis) - at;
      // A vertex in the plane counts as in front of it: no edge is met twice.
      if ((da >= 0) != (db >= 0)) points[count++] = frame.scene_of(between(a, b, da / (da - db)));
    }
    if (count == 2) cut.insert(cut.end(), points.begin(), points.begin() + 2);
  }
  return cut;
}

}  // namespace footwall::render
