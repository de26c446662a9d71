#include "ui/scene3d/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace footwall::ui {
namespace {

using render::Vec3;
using render::Vec3f;

constexpr std::size_t kFan = 16;
constexpr Vec3f kNowhereLo{INFINITY, INFINITY, INFINITY};
constexpr Vec3f kNowhereHi{-INFINITY, -INFINITY, -INFINITY};

void grow(Vec3f& lo, Vec3f& hi, const Vec3f& from, const Vec3f& to) {
  lo = {std::min(lo.x, from.x), std::min(lo.y, from.y), std::min(lo.z, from.z)};
  hi = {std::max(hi.x, to.x), std::max(hi.y, to.y), std::max(hi.z, to.z)};
}

// Based on: Moeller and Trumbore, fast minimum storage ray/triangle intersection, 1997.
std::optional<double> hit_of(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 p = cross(ray.along, ac);
  const double det = dot(ab, p);
  if (det == 0 || !std::isfinite(det)) return {};
  const Vec3 s = ray.from - a;
  const double u = dot(s, p) / det;
  const Vec3 q = cross(s, ab);
  const double v = dot(ray.along, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return {};
  const double t = dot(ac, q) / det;
  if (!(t > 0)) return {};
  return t;
}

}  // namespace

std::optional<double> entry_of(const Ray& ray, const Vec3f& lo, const Vec3f& hi, double farthest) {
  double enter = 0;
  double leave = farthest;
  const auto slab = [&](double from, double along, double low, double high) {
    if (along == 0) {
      if (from < low || from > high) leave = -1;
      return;
    }
    double a = (low - from) / along;
    double b = (high - from) / along;
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  };
  slab(ray.from.x, ray.along.x, lo.x, hi.x);
  slab(ray.from.y, ray.along.y, lo.y, hi.y);
  slab(ray.from.z, ray.along.z, lo.z, hi.z);
  if (!(enter <= leave)) return {};
  return enter;
}

RayTree::RayTree(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners)
    : positions_(positions), corners_(corners) {
  const std::size_t faces = corners.size() / 3;
  std::vector<Box> boxes((faces + kFan - 1) / kFan, Box{kNowhereLo, kNowhereHi});
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Vec3f& p = positions[corners[n]];
    Box& box = boxes[n / 3 / kFan];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) grow(box.lo, box.hi, p, p);
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > kFan) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + kFan - 1) / kFan, Box{kNowhereLo, kNowhereHi});
    for (std::size_t n = 0; n < below.size(); ++n)
      grow(above[n / kFan].lo, above[n / kFan].hi, below[n].lo, below[n].hi);
    levels_.push_back(std::move(above));
  }
  Box whole{kNowhereLo, kNowhereHi};
  for (const Box& box : levels_.back()) grow(whole.lo, whole.hi, box.lo, box.hi);
  bounds_ = {Vec3(whole.lo), Vec3(whole.hi)};
}

std::optional<RayHit> RayTree::first_hit(const Ray& ray, double farthest) const {
  if (levels_.empty()) return {};
  RayHit best{.distance = farthest, .face = -1};
  for (std::size_t n = 0; n < levels_.back().size(); ++n) visit(levels_.size() - 1, n, ray, &best);
  if (best.face < 0) return {};
  return best;
}

void RayTree::visit(std::size_t level, std::size_t at, const Ray& ray, RayHit* best) const {
  const Box& box = levels_[level][at];
  if (!entry_of(ray, box.lo, box.hi, best->distance)) return;
  if (level > 0) {
    const std::size_t end = std::min((at + 1) * kFan, levels_[level - 1].size());
    for (std::size_t n = at * kFan; n < end; ++n) visit(level - 1, n, ray, best);
    return;
  }
  const std::size_t end = std::min((at + 1) * kFan, corners_.size() / 3);
  for (std::size_t face = at * kFan; face < end; ++face) {
    const auto corner = [&](std::size_t n) { return Vec3(positions_[corners_[3 * face + n]]); };
    const auto hit = hit_of(ray, corner(0), corner(1), corner(2));
    if (hit && *hit < best->distance) *best = {.distance = *hit, .face = static_cast<std::int32_t>(face)};
  }
}

}  // namespace footwall::ui
