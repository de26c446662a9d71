// Many vertices to fixed point, as many at once as a vector has doubles: each operation is the one that
// projected() does, rounded alike, so that the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/project_vertices.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <limits>

#include "engine/render/rasterizer.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void project_all(const Matrix4& m, std::span<const Vec3f> positions, int width, int height,
                 std::span<ScreenVertex> to) {
  std::size_t n = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> floats;
  const hn::Rebind<std::int32_t, decltype(d)> ints;
  const std::size_t lanes = hn::Lanes(d);
  const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  const auto zero = hn::Zero(d);
  const auto half = set(0.5);
  const auto one = set(1);
  const auto greatest = set(std::numeric_limits<double>::max());
  const auto guard_x = set(2.0 * kGuardBand / width);
  const auto guard_y = set(2.0 * kGuardBand / height);
  const auto pixels_x = set(width);
  const auto pixels_y = set(height);
  const auto sub_pixels = set(kSubPixels);
  for (; n + lanes <= positions.size(); n += lanes) {
    hn::Vec<decltype(floats)> fx, fy, fz;
    hn::LoadInterleaved3(floats, &positions[n].x, fx, fy, fz);
    const auto px = hn::PromoteTo(d, fx);
    const auto py = hn::PromoteTo(d, fy);
    const auto pz = hn::PromoteTo(d, fz);
    const auto row = [&](std::size_t r) HWY_ATTR {
      const auto xy = hn::Add(hn::Mul(set(m[4 * r]), px), hn::Mul(set(m[4 * r + 1]), py));
      return hn::Add(hn::Add(xy, hn::Mul(set(m[4 * r + 2]), pz)), set(m[4 * r + 3]));
    };
    const auto x = row(0);
    const auto y = row(1);
    const auto z = row(2);
    const auto w = row(3);
    const auto wide = hn::Mul(guard_x, w);
    const auto high = hn::Mul(guard_y, w);
    // False for what is not a number, too.
    auto inside = hn::And(hn::Gt(w, zero), hn::Le(w, greatest));
    inside = hn::And(inside, hn::And(hn::Ge(hn::Add(w, z), zero), hn::Ge(hn::Sub(w, z), zero)));
    inside = hn::And(inside, hn::And(hn::Ge(hn::Add(wide, x), zero), hn::Ge(hn::Sub(wide, x), zero)));
    inside = hn::And(inside, hn::And(hn::Ge(hn::Add(high, y), zero), hn::Ge(hn::Sub(high, y), zero)));
    if (!hn::AllTrue(d, inside)) {
      for (std::size_t k = n; k < n + lanes; ++k)
        to[k] = projected(transformed(m, Vec3(positions[k])), width, height);
      continue;
    }
    const auto inverse = hn::Div(one, w);
    const auto along_x =
        hn::Mul(hn::Mul(hn::Add(hn::Mul(hn::Mul(x, inverse), half), half), pixels_x), sub_pixels);
    const auto along_y =
        hn::Mul(hn::Mul(hn::Sub(half, hn::Mul(hn::Mul(y, inverse), half)), pixels_y), sub_pixels);
    const auto far = hn::DemoteTo(floats, hn::Add(hn::Mul(hn::Mul(z, inverse), half), half));
    const auto depth = hn::Clamp(far, hn::Zero(floats), hn::Set(floats, 1.0F));
    hn::StoreInterleaved4(hn::DemoteTo(ints, hn::Round(along_x)), hn::DemoteTo(ints, hn::Round(along_y)),
                          hn::BitCast(ints, depth), hn::Zero(ints), ints, &to[n].x);
  }
#endif
  for (; n < positions.size(); ++n) to[n] = projected(transformed(m, Vec3(positions[n])), width, height);
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "storage/base/error.h"

namespace footwall::render {
namespace {

HWY_EXPORT(project_all);

}  // namespace

void project(const Matrix4& view_projection, std::span<const Vec3f> positions, int width, int height,
             std::span<ScreenVertex> to) {
  require(to.size() == positions.size(), "one projected vertex per position");
  HWY_DYNAMIC_DISPATCH(project_all)(view_projection, positions, width, height, to);
}

}  // namespace footwall::render
#endif
