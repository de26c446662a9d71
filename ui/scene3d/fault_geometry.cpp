#include "ui/scene3d/fault_geometry.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace footwall::ui {
namespace {

using render::Vec3f;

// Each vertex' stand-in: the first vertex in its cell of a grid.
std::vector<std::uint32_t> stand_ins(const std::vector<Vec3f>& positions, const render::Bounds& bounds,
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

FaultGeometry::FaultGeometry(std::shared_ptr<const FaultSurface> surface, const ToScene& to_scene)
    : surface_(std::move(surface)),
      bounds_{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}} {
  positions_.reserve(surface_->vertices.size());
  for (const survey::WorldPoint& vertex : surface_->vertices) {
    const render::Vec3 p = to_scene(vertex);
    positions_.emplace_back(p);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    bounds_.lo = {std::min(bounds_.lo.x, p.x), std::min(bounds_.lo.y, p.y), std::min(bounds_.lo.z, p.z)};
    bounds_.hi = {std::max(bounds_.hi.x, p.x), std::max(bounds_.hi.y, p.y), std::max(bounds_.hi.z, p.z)};
  }
  corners_.reserve(3 * surface_->faces.size());
  for (const project::MeshFace& face : surface_->faces) {
    for (const std::int32_t vertex : face.vertices) {
      const auto n = static_cast<std::uint32_t>(vertex);
      corners_.push_back(n < positions_.size() ? n : 0);
    }
  }
  if (positions_.empty()) corners_.clear();
}

const RayTree& FaultGeometry::tree() const {
  if (!tree_) tree_.emplace(positions_, corners_);
  return *tree_;
}

const std::vector<Vec3f>& FaultGeometry::outline() const {
  if (outline_) return *outline_;
  std::vector<std::uint64_t> edges;
  edges.reserve(corners_.size());
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    const std::uint64_t a = corners_[n];
    const std::uint64_t b = corners_[n % 3 == 2 ? n - 2 : n + 1];
    edges.push_back(std::min(a, b) << 32U | std::max(a, b));
  }
  std::ranges::sort(edges);
  outline_.emplace();
  for (std::size_t n = 0; n < edges.size();) {
    std::size_t end = n + 1;
    while (end < edges.size() && edges[end] == edges[n]) ++end;
    if (end == n + 1) {
      outline_->push_back(positions_[edges[n] >> 32U]);
      outline_->push_back(positions_[edges[n] & 0xFFFFFFFFU]);
    }
    n = end;
  }
  return *outline_;
}

CoarseFaces FaultGeometry::coarse(std::size_t most) const {
  CoarseFaces result;
  const std::size_t count = face_count();
  if (count <= most) {
    result.corners = corners_;
    result.faces.resize(count);
    for (std::size_t n = 0; n < count; ++n) result.faces[n] = static_cast<std::uint32_t>(n);
    return result;
  }
  double area = 0;
  for (std::size_t n = 0; n < corners_.size(); n += 3) {
    const render::Vec3 at(positions_[corners_[n]]);
    const double one = length(cross(render::Vec3(positions_[corners_[n + 1]]) - at,
                                    render::Vec3(positions_[corners_[n + 2]]) - at)) /
                       2;
    if (std::isfinite(one)) area += one;
  }
  // A surface has about two faces per cell that it passes through.
  double cell = std::sqrt(2.5 * area / static_cast<double>(std::max<std::size_t>(most, 1)));
  do {
    result = {};
    const std::vector<std::uint32_t> chosen = stand_ins(positions_, bounds_, std::max(cell, 1e-9));
    for (std::size_t face = 0; face < count; ++face) {
      const std::uint32_t a = chosen[corners_[3 * face]];
      const std::uint32_t b = chosen[corners_[3 * face + 1]];
      const std::uint32_t c = chosen[corners_[3 * face + 2]];
      if (a == b || b == c || c == a) continue;
      result.corners.insert(result.corners.end(), {a, b, c});
      result.faces.push_back(static_cast<std::uint32_t>(face));
    }
    cell = 1.3 * cell + 1e-9;
  } while (result.faces.size() > most);
  return result;
}

}  // namespace footwall::ui
