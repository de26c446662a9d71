#include "ui/scene3d/fault_geometry.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

using render::Vec3f;

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
  return coarse_faces(positions_, corners_, bounds_, most);
}

}  // namespace footwall::ui
