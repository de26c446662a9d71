#include "engine/isosurface/visible/paper/screen_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace footwall::isosurface {
namespace {

// Vertices are rounded to half a sub-pixel either way; the rest is for the arithmetic before that.
constexpr double kMargin = 2.0 / render::kSubPixels;

struct Extent {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void hold(double at) {
    lo = std::min(lo, at);
    hi = std::max(hi, at);
  }
  // The first pixel whose centre is held, and the one after the last.
  int first(int size) const {
    return static_cast<int>(std::clamp(std::ceil(lo - kMargin - 0.5), 0.0, 1.0 * size));
  }
  int end(int size) const {
    return static_cast<int>(std::clamp(std::floor(hi + kMargin - 0.5) + 1, 0.0, 1.0 * size));
  }
};

double beyond_near(const render::Vec4& p) {
  return p.w + p.z;
}

}  // namespace

render::PixelRect screen_box(const survey::Box& cells, const render::Matrix4& to_clip, int width,
                             int height) {
  const render::PixelRect whole{0, 0, width, height};
  std::array<render::Vec4, 8> corners;
  for (unsigned n = 0; n < 8; ++n) {
    const auto at = [&](unsigned axis) {
      return static_cast<double>((n >> axis & 1U) != 0 ? cells.hi[axis] : cells.lo[axis]);
    };
    corners[n] = render::transformed(to_clip, {at(0), at(1), at(2)});
    const render::Vec4& p = corners[n];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w))
      return whole;
  }
  Extent along_x;
  Extent along_y;
  bool divisible = true;
  const auto hold = [&](double x, double y, double w) {
    divisible = divisible && w > 0;
    along_x.hold((x / w * 0.5 + 0.5) * width);
    along_y.hold((0.5 - y / w * 0.5) * height);
  };
  for (unsigned n = 0; n < 8; ++n) {
    const render::Vec4& p = corners[n];
    if (beyond_near(p) >= 0) hold(p.x, p.y, p.w);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const render::Vec4& q = corners[n ^ 1U << axis];
      if (beyond_near(p) < 0 || beyond_near(q) >= 0) continue;
      const double share = beyond_near(p) / (beyond_near(p) - beyond_near(q));
      hold(p.x + (q.x - p.x) * share, p.y + (q.y - p.y) * share, p.w + (q.w - p.w) * share);
    }
  }
  if (along_x.lo > along_x.hi) return {};  // behind the eye
  if (!divisible) return whole;            // only through a matrix whose near plane does not keep the eye out
  const render::PixelRect box{along_x.first(width), along_y.first(height), along_x.end(width),
                              along_y.end(height)};
  return box.empty() ? render::PixelRect{} : box;
}

}  // namespace footwall::isosurface
