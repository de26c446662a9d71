#include "ui/scene3d/coarse_faces.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace footwall::ui {
namespace {

using render::Vec3f;

// Each vertex' stand-in: the first vertex in its cell of a grid.
std::vector<std::uint32_t> stand_ins(std::span<const Vec3f> positions, const render::Bounds& bounds,
                                     double cell) {
  std::unordered_map<std::uint64_t, std::uint32_t> first;
  first.reserve(positions.size());
  std::vector<std::uint32_t> chosen(positions.size());
  const auto step = [cell](double value, double low) {
    return std::isfinite(value) ? static_cast<std::uint64_t>((value - low) / cell) & 0x1FFFFFU : 0x1FFFFFU;
  };
  for (std::size_t n = 0; n < positions.size(); ++n) {
    const Vec3f& p = positions[n];
    const std::uint64_t key =
        step(p.x, bounds.lo.x) << 42U | step(p.y, bounds.lo.y) << 21U | step(p.z, bounds.lo.z);
    chosen[n] = first.try_emplace(key, static_cast<std::uint32_t>(n)).first->second;
  }
  return chosen;
}

}  // namespace

CoarseFaces coarse_faces(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners,
                         const render::Bounds& bounds, std::size_t most) {
  CoarseFaces result;
  const std::size_t count = corners.size() / 3;
  if (count <= most) {
    result.corners.assign(corners.begin(), corners.end());
    result.faces.resize(count);
    for (std::size_t n = 0; n < count; ++n) result.faces[n] = static_cast<std::uint32_t>(n);
    return result;
  }
  double area = 0;
  for (std::size_t n = 0; n < corners.size(); n += 3) {
    const render::Vec3 at(positions[corners[n]]);
    const double one = length(cross(render::Vec3(positions[corners[n + 1]]) - at,
                                    render::Vec3(positions[corners[n + 2]]) - at)) /
                       2;
    if (std::isfinite(one)) area += one;
  }
  // A surface has about two faces per cell that it passes through.
  double cell = std::sqrt(2.5 * area / static_cast<double>(std::max<std::size_t>(most, 1)));
  do {
    result = {};
    const std::vector<std::uint32_t> chosen = stand_ins(positions, bounds, std::max(cell, 1e-9));
    for (std::size_t face = 0; face < count; ++face) {
      const std::uint32_t a = chosen[corners[3 * face]];
      const std::uint32_t b = chosen[corners[3 * face + 1]];
      const std::uint32_t c = chosen[corners[3 * face + 2]];
      if (a == b || b == c || c == a) continue;
      result.corners.insert(result.corners.end(), {a, b, c});
      result.faces.push_back(static_cast<std::uint32_t>(face));
    }
    cell = 1.3 * cell + 1e-9;
  } while (result.faces.size() > most);
  return result;
}

}  // namespace footwall::ui
