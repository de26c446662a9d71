// Compiled once per instruction set and chosen at run time; every operation is exact or rounded alike on all
// of them (no fused multiply-add), so that each draws the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/rasterizer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>

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
constexpr std::int32_t kHalf = kSubPixels / 2;

// The first and last pixel whose centre lies in a closed interval of sub-pixels.
constexpr std::int32_t first_pixel(std::int32_t at) {
  return (at + kHalf - 1) >> kSubPixelBits;
}
constexpr std::int32_t last_pixel(std::int32_t at) {
  return (at - kHalf) >> kSubPixelBits;
}

// A centre on an edge belongs to the triangle for which the edge is a left or a top one (corners in clockwise
// order as seen, y downwards): -1 takes the zero away from the others.
constexpr std::int32_t edge_bias(std::int32_t dx, std::int32_t dy) {
  return dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
}

// E over the edge from a to b at p, > 0 to its right as seen.
template <class Int>
constexpr Int edge_at(Int ax, Int ay, Int bx, Int by, Int px, Int py) {
  return (bx - ax) * (py - ay) - (by - ay) * (px - ax);
}

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
  const std::int32_t px = x0 * kSubPixels + kHalf;
  const std::int32_t py = y0 * kSubPixels + kHalf;
  const std::int32_t bias_a = edge_bias(c.x - b.x, c.y - b.y);
  const std::int32_t bias_b = edge_bias(a.x - c.x, a.y - c.y);
  const std::int32_t bias_c = edge_bias(b.x - a.x, b.y - a.y);
  std::int32_t row_a = edge_at(b.x, b.y, c.x, c.y, px, py) + bias_a;
  std::int32_t row_b = edge_at(c.x, c.y, a.x, a.y, px, py) + bias_b;
  std::int32_t row_c = edge_at(a.x, a.y, b.x, b.y, px, py) + bias_c;
  const std::int32_t right_a = (b.y - c.y) * kSubPixels;
  const std::int32_t right_b = (c.y - a.y) * kSubPixels;
  const std::int32_t right_c = (a.y - b.y) * kSubPixels;
  const std::int32_t down_a = (c.x - b.x) * kSubPixels;
  const std::int32_t down_b = (a.x - c.x) * kSubPixels;
  const std::int32_t down_c = (b.x - a.x) * kSubPixels;
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
              static_cast<float>(eb - bias_b) * rise_b + static_cast<float>(ec - bias_c) * rise_c;
          row[x] = std::min(row[x], visible(std::clamp(a.depth + rise, 0.0F, 1.0F), id));
        }
        ea += right_a;
        eb += right_b;
        ec += right_c;
      }
      row_a += down_a;
      row_b += down_b;
      row_c += down_c;
    }
    return;
  }
  const hn::CappedTag<float, 8> floats;
  const hn::RebindToSigned<decltype(floats)> ints;
  const auto step = static_cast<std::int32_t>(hn::Lanes(ints));
  const auto lane = hn::Iota(ints, 0);
  const auto lanes_a = hn::Mul(lane, hn::Set(ints, right_a));
  const auto lanes_b = hn::Mul(lane, hn::Set(ints, right_b));
  const auto lanes_c = hn::Mul(lane, hn::Set(ints, right_c));
  const auto ids = hn::Set(ints, static_cast<std::int32_t>(id));
  for (std::int32_t y = y0; y <= y1; ++y, row += width) {
    for (std::int32_t x = x0; x <= x1; x += step) {
      const auto ea = hn::Add(hn::Set(ints, row_a + (x - x0) * right_a), lanes_a);
      const auto eb = hn::Add(hn::Set(ints, row_b + (x - x0) * right_b), lanes_b);
      const auto ec = hn::Add(hn::Set(ints, row_c + (x - x0) * right_c), lanes_c);
      // All ones, which no merge keeps, where a centre is outside of the triangle or of the row.
      const auto left_over = hn::Sub(hn::Set(ints, x1 - x), lane);
      const auto outside = hn::BroadcastSignBit(hn::Or(hn::Or(ea, eb), hn::Or(ec, left_over)));
      if (hn::AllTrue(ints, hn::Lt(outside, hn::Zero(ints)))) continue;
      const auto weight_b = hn::ConvertTo(floats, hn::Sub(eb, hn::Set(ints, bias_b)));
      const auto weight_c = hn::ConvertTo(floats, hn::Sub(ec, hn::Set(ints, bias_c)));
      const auto rise =
          hn::Add(hn::Mul(weight_b, hn::Set(floats, rise_b)), hn::Mul(weight_c, hn::Set(floats, rise_c)));
      const auto depth =
          hn::Clamp(hn::Add(hn::Set(floats, a.depth), rise), hn::Zero(floats), hn::Set(floats, 1.0F));
      merge_pixels(ints, hn::Or(hn::BitCast(ints, depth), outside), hn::Or(ids, outside), row + x);
    }
    row_a += down_a;
    row_b += down_b;
    row_c += down_c;
  }
}

struct Edge {
  std::int64_t at_first;  // at the centre of pixel (0, first row), biased
  std::int64_t right;     // per pixel
  std::int64_t down;
  std::int64_t bias;
};

Edge edge_between(const ScreenVertex& a, const ScreenVertex& b, std::int32_t row) {
  const std::int64_t bias = edge_bias(b.x - a.x, b.y - a.y);
  return {edge_at<std::int64_t>(a.x, a.y, b.x, b.y, kHalf, std::int64_t{row} * kSubPixels + kHalf) + bias,
          (std::int64_t{a.y} - b.y) * kSubPixels, (std::int64_t{b.x} - a.x) * kSubPixels, bias};
}

constexpr std::int64_t floor_divided(std::int64_t a, std::int64_t positive) {
  return a >= 0 ? a / positive : -((-a + positive - 1) / positive);
}

// Narrows [x0, x1] to the pixels of this row inside the edge, exactly.
void narrow(const Edge& edge, std::int64_t at_row, std::int64_t& x0, std::int64_t& x1) {
  if (edge.right > 0) {
    x0 = std::max(x0, -floor_divided(at_row, edge.right));
  } else if (edge.right < 0) {
    x1 = std::min(x1, floor_divided(at_row, -edge.right));
  } else if (at_row < 0) {
    x1 = x0 - 1;
  }
}

// Row by row, each row one span found by division: no pixel outside is looked at.
void fill_large(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::int64_t area,
                std::int32_t x0, std::int32_t x1, std::int32_t y0, std::int32_t y1, PrimitiveId id,
                VisibilityBuffer& into) {
  const Edge ea = edge_between(b, c, y0);
  const Edge eb = edge_between(c, a, y0);
  const Edge ec = edge_between(a, b, y0);
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
    narrow(ea, ea.at_first + ea.down * down, from, to);
    narrow(eb, eb.at_first + eb.down * down, from, to);
    narrow(ec, ec.at_first + ec.down * down, from, to);
    if (from > to) continue;
    const auto weight_b = static_cast<double>(eb.at_first + eb.down * down + eb.right * from - eb.bias);
    const auto weight_c = static_cast<double>(ec.at_first + ec.down * down + ec.right * from - ec.bias);
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
    const std::int32_t area = edge_at(a.x, a.y, b.x, b.y, c.x, c.y);
    if (area > 0) fill_small(a, b, c, area, x0, x1, y0, y1, id, into);
    if (area < 0) fill_small(a, c, b, -area, x0, x1, y0, y1, id, into);
  } else {
    const std::int64_t area = edge_at<std::int64_t>(a.x, a.y, b.x, b.y, c.x, c.y);
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
