#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/visible/detail/met_triangles.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "engine/isosurface/visible/detail/met_triangles.h"

#ifndef FOOTWALL_ISOSURFACE_LARGE_TRIANGLES
#define FOOTWALL_ISOSURFACE_LARGE_TRIANGLES
namespace footwall::isosurface::detail {

// Larger triangles are drawn without a look at what is before them.
inline constexpr std::int32_t kLarge = 64;

// With its box, x0 > x1 or y0 > y1 where it meets no centre.
inline bool is_hidden(const EarlierWaves& earlier, std::int32_t x0, std::int32_t y0, std::int32_t x1,
                      std::int32_t y1, float depth) {
  if (earlier.depths == nullptr || x1 - x0 > kLarge || y1 - y0 > kLarge) return false;
  const render::CoarseDepth nearest = earlier.scale.of_box(depth);
  return earlier.depths->hides({static_cast<std::int16_t>(x0), static_cast<std::int16_t>(y0),
                                static_cast<std::int16_t>(x1), static_cast<std::int16_t>(y1), nearest,
                                nearest});
}

}  // namespace footwall::isosurface::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::int32_t kHalf = render::kSubPixels / 2;

#if HWY_TARGET == HWY_SCALAR

bool is_met(const Screen& screen, const Triangle& corners) {
  const render::ScreenVertex& a = screen.vertices[corners[0]];
  const render::ScreenVertex& b = screen.vertices[corners[1]];
  const render::ScreenVertex& c = screen.vertices[corners[2]];
  if ((a.outside | b.outside | c.outside) != 0) return (a.outside & b.outside & c.outside) == 0;
  const auto first = [](std::int32_t p, std::int32_t q, std::int32_t r) {
    return std::max((std::min({p, q, r}) + kHalf - 1) >> render::kSubPixelBits, 0);
  };
  const auto last = [](std::int32_t p, std::int32_t q, std::int32_t r, int size) {
    return std::min((std::max({p, q, r}) - kHalf) >> render::kSubPixelBits, size - 1);
  };
  const std::int32_t x0 = first(a.x, b.x, c.x);
  const std::int32_t y0 = first(a.y, b.y, c.y);
  const std::int32_t x1 = last(a.x, b.x, c.x, screen.width);
  const std::int32_t y1 = last(a.y, b.y, c.y, screen.height);
  return x0 <= x1 && y0 <= y1 &&
         !is_hidden(screen.earlier, x0, y0, x1, y1, std::min({a.depth, b.depth, c.depth}));
}

#else

// x, y, depth, outside at once: bits of depths order as the numbers do.
bool is_met(const Screen& screen, const Triangle& corners) {
  const hn::FixedTag<std::int32_t, 4> d;
  const render::ScreenVertex* const vertices = screen.vertices.data();
  const auto a = hn::LoadU(d, &vertices[corners[0]].x);
  const auto b = hn::LoadU(d, &vertices[corners[1]].x);
  const auto c = hn::LoadU(d, &vertices[corners[2]].x);
  const auto lo = hn::Min(hn::Min(a, b), c);
  const auto hi = hn::Max(hn::Max(a, b), c);
  alignas(16) const std::int32_t sizes[4] = {screen.width - 1, screen.height - 1, 0, 0};
  const auto first =
      hn::Max(hn::ShiftRight<render::kSubPixelBits>(hn::Add(lo, hn::Set(d, kHalf - 1))), hn::Zero(d));
  const auto last =
      hn::Min(hn::ShiftRight<render::kSubPixelBits>(hn::Sub(hi, hn::Set(d, kHalf))), hn::Load(d, sizes));
  if (HWY_UNLIKELY(hn::ExtractLane(hi, 3) != 0)) {
    return hn::ExtractLane(hn::And(hn::And(a, b), c), 3) == 0;
  }
  const hn::FixedTag<std::uint64_t, 2> pairs;
  constexpr std::uint64_t kNone = 0x8000000080000000;  // either difference is negative
  if ((hn::GetLane(hn::BitCast(pairs, hn::Sub(last, first))) & kNone) != 0) return false;
  if (screen.earlier.depths == nullptr) return true;
  alignas(16) std::int32_t x0y0[4];
  alignas(16) std::int32_t x1y1[4];
  hn::Store(first, d, x0y0);
  hn::Store(last, d, x1y1);
  return !is_hidden(screen.earlier, x0y0[0], x0y0[1], x1y1[0], x1y1[1],
                    std::bit_cast<float>(hn::ExtractLane(lo, 2)));
}

#endif

std::size_t keep(const Screen& screen, Triangle* triangles, std::size_t first, std::size_t end,
                 std::size_t to) {
  for (std::size_t t = first; t < end; ++t) {
    const Triangle corners = triangles[t];
    triangles[to] = corners;
    to += is_met(screen, corners) ? 1 : 0;
  }
  return to;
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(keep);

}  // namespace

std::size_t keep_met(const Screen& screen, std::span<Triangle> triangles, std::size_t first, std::size_t end,
                     std::size_t to) {
  return HWY_DYNAMIC_DISPATCH(keep)(screen, triangles.data(), first, end, to);
}

}  // namespace footwall::isosurface::detail
#endif
