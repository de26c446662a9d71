// Compiled once per instruction set and chosen at run time; every operation is exact or rounded alike on all
// of them (no fused multiply-add), so that each draws the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/rasterizer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>

#include "engine/render/edge_function.h"
#include "engine/render/rasterizer.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Triangles up to this many pixels wide and high take 32-bit edge functions: |E| <= 2 * (64 * 256)^2 = 2^29.
constexpr std::int32_t kSmall = 64 * kSubPixels;
// Narrower boxes are looked at pixel by pixel: overlapping wide stores of neighbours would wait for each
// other.
constexpr std::int32_t kNarrow = 3;

// Keeps the nearer of each pixel, for as many pixels as `ints` has lanes.
template <class Ints, class Vec>
HWY_INLINE void merge_pixels([[maybe_unused]] Ints ints, Vec depths, Vec ids, Visible* HWY_RESTRICT pixels) {
#if HWY_TARGET == HWY_SCALAR
  const auto depth = static_cast<std::uint32_t>(hn::GetLane(depths));
  const auto id = static_cast<std::uint32_t>(hn::GetLane(ids));
  *pixels = std::min(*pixels, static_cast<Visible>(depth) << 32U | id);
#else
  const hn::RebindToUnsigned<Ints> whole;
  const hn::Half<decltype(whole)> half;
  const hn::RepartitionToWide<decltype(whole)> wide;
  const auto merge = [&](auto depth_half, auto id_half, Visible* HWY_RESTRICT at) HWY_ATTR {
    const auto here =
        hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(wide, depth_half)), hn::PromoteTo(wide, id_half));
    hn::StoreU(hn::Min(here, hn::LoadU(wide, at)), wide, at);
  };
  const auto d = hn::BitCast(whole, depths);
  const auto n = hn::BitCast(whole, ids);
  merge(hn::LowerHalf(half, d), hn::LowerHalf(half, n), pixels);
  merge(hn::UpperHalf(half, d), hn::UpperHalf(half, n), pixels + hn::Lanes(half));
#endif
}

// Depth is interpolated with the exact edge functions as barycentric weights, so it stays between the
// corners' depths however thin the triangle.
void fill_small(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::int32_t area,
                std::int32_t x0, std::int32_t x1, std::int32_t y0, std::int32_t y1, PrimitiveId id,
                VisibilityBuffer& into) {
  const EdgeFunction<std::int32_t> edge_a(b, c, x0, y0);
  const EdgeFunction<std::int32_t> edge_b(c, a, x0, y0);
  const EdgeFunction<std::int32_t> edge_c(a, b, x0, y0);
  std::int32_t row_a = edge_a.at;
  std::int32_t row_b = edge_b.at;
  std::int32_t row_c = edge_c.at;
  const float inverse = 1.0F / static_cast<float>(area);
  const float rise_b = (b.depth - a.depth) * inverse;
  const float rise_c = (c.depth - a.depth) * inverse;
  const auto width = static_cast<std::size_t>(into.width());
  Visible* row = into.pixels().data() + static_cast<std::size_t>(y0 - into.first_row()) * width;
  if (x1 - x0 < kNarrow) {
    for (std::int32_t y = y0; y <= y1; ++y, row += width) {
      std::int32_t ea = row_a;
      std::int32_t eb = row_b;
      std::int32_t ec = row_c;
      for (std::int32_t x = x0; x <= x1; ++x) {
        if ((ea | eb | ec) >= 0) {
          const float rise =
              static_cast<float>(eb - edge_b.bias) * rise_b + static_cast<float>(ec - edge_c.bias) * rise_c;
          row[x] = std::min(row[x], visible(std::clamp(a.depth + rise, 0.0F, 1.0F), id));
        }
        ea += edge_a.right;
        eb += edge_b.right;
        ec += edge_c.right;
      }
      row_a += edge_a.down;
      row_b += edge_b.down;
      row_c += edge_c.down;
    }
    return;
  }
  const hn::CappedTag<float, 8> floats;
  const hn::RebindToSigned<decltype(floats)> ints;
  const auto step = static_cast<std::int32_t>(hn::Lanes(ints));
  const auto lane = hn::Iota(ints, 0);
  const auto lanes_a = hn::Mul(lane, hn::Set(ints, edge_a.right));
  const auto lanes_b = hn::Mul(lane, hn::Set(ints, edge_b.right));
  const auto lanes_c = hn::Mul(lane, hn::Set(ints, edge_c.right));
  const auto ids = hn::Set(ints, static_cast<std::int32_t>(id));
  for (std::int32_t y = y0; y <= y1; ++y, row += width) {
    for (std::int32_t x = x0; x <= x1; x += step) {
      const auto ea = hn::Add(hn::Set(ints, row_a + (x - x0) * edge_a.right), lanes_a);
      const auto eb = hn::Add(hn::Set(ints, row_b + (x - x0) * edge_b.right), lanes_b);
      const auto ec = hn::Add(hn::Set(ints, row_c + (x - x0) * edge_c.right), lanes_c);
      // All ones, which no merge keeps, where a centre is outside of the triangle or of the row.
      const auto left_over = hn::Sub(hn::Set(ints, x1 - x), lane);
      const auto outside = hn::BroadcastSignBit(hn::Or(hn::Or(ea, eb), hn::Or(ec, left_over)));
      if (hn::AllTrue(ints, hn::Lt(outside, hn::Zero(ints)))) continue;
      const auto weight_b = hn::ConvertTo(floats, hn::Sub(eb, hn::Set(ints, edge_b.bias)));
      const auto weight_c = hn::ConvertTo(floats, hn::Sub(ec, hn::Set(ints, edge_c.bias)));
      const auto rise =
          hn::Add(hn::Mul(weight_b, hn::Set(floats, rise_b)), hn::Mul(weight_c, hn::Set(floats, rise_c)));
      const auto depth =
          hn::Clamp(hn::Add(hn::Set(floats, a.depth), rise), hn::Zero(floats), hn::Set(floats, 1.0F));
      merge_pixels(ints, hn::Or(hn::BitCast(ints, depth), outside), hn::Or(ids, outside), row + x);
    }
    row_a += edge_a.down;
    row_b += edge_b.down;
    row_c += edge_c.down;
  }
}

// Row by row, each row one span found by division: no pixel outside is looked at.
void fill_large(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::int64_t area,
                std::int32_t x0, std::int32_t x1, std::int32_t y0, std::int32_t y1, PrimitiveId id,
                VisibilityBuffer& into) {
  const EdgeFunction<std::int64_t> ea(b, c, 0, y0);
  const EdgeFunction<std::int64_t> eb(c, a, 0, y0);
  const EdgeFunction<std::int64_t> ec(a, b, 0, y0);
  const double rise_b = (static_cast<double>(b.depth) - a.depth) / static_cast<double>(area);
  const double rise_c = (static_cast<double>(c.depth) - a.depth) / static_cast<double>(area);
  const double rise_right = static_cast<double>(eb.right) * rise_b + static_cast<double>(ec.right) * rise_c;
  const double nearest = std::min({a.depth, b.depth, c.depth});
  const double farthest = std::max({a.depth, b.depth, c.depth});
  const auto width = static_cast<std::size_t>(into.width());
  Visible* row = into.pixels().data() + static_cast<std::size_t>(y0 - into.first_row()) * width;
  for (std::int64_t down = 0; down <= y1 - y0; ++down, row += width) {
    std::int64_t from = x0;
    std::int64_t to = x1;
    ea.narrow(down, from, to);
    eb.narrow(down, from, to);
    ec.narrow(down, from, to);
    if (from > to) continue;
    const auto weight_b = static_cast<double>(eb.at + eb.down * down + eb.right * from - eb.bias);
    const auto weight_c = static_cast<double>(ec.at + ec.down * down + ec.right * from - ec.bias);
    const double depth_at_first = a.depth + (weight_b * rise_b + weight_c * rise_c);
    for (std::int64_t x = from; x <= to; ++x) {
      const double depth =
          depth_at_first + static_cast<double>(static_cast<std::int32_t>(x - from)) * rise_right;
      const Visible here = visible(static_cast<float>(std::clamp(depth, nearest, farthest)), id);
      row[x] = std::min(row[x], here);
    }
  }
}

void draw_triangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, PrimitiveId id,
                   VisibilityBuffer& into) {
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const std::int32_t x0 = std::max(first_pixel(left), 0);
  const std::int32_t x1 = std::min(last_pixel(right), into.width() - 1);
  const std::int32_t y0 = std::max(first_pixel(top), into.first_row());
  const std::int32_t y1 = std::min(last_pixel(bottom), into.first_row() + into.rows() - 1);
  if (x0 > x1 || y0 > y1) return;
  if (right - left <= kSmall && bottom - top <= kSmall) {
    const std::int32_t area = twice_area<std::int32_t>(a, b, c);
    if (area > 0) fill_small(a, b, c, area, x0, x1, y0, y1, id, into);
    if (area < 0) fill_small(a, c, b, -area, x0, x1, y0, y1, id, into);
  } else {
    const std::int64_t area = twice_area<std::int64_t>(a, b, c);
    if (area > 0) fill_large(a, b, c, area, x0, x1, y0, y1, id, into);
    if (area < 0) fill_large(a, c, b, -area, x0, x1, y0, y1, id, into);
  }
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::render {
namespace {

HWY_EXPORT(draw_triangle);

}  // namespace

void rasterize_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, PrimitiveId id,
                      VisibilityBuffer& into) {
  HWY_DYNAMIC_DISPATCH(draw_triangle)(a, b, c, id, into);
}

}  // namespace footwall::render
#endif
