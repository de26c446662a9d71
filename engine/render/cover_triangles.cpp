// Triangles into a coverage mask. Eight pixels of a row at once; coverage is decided on the same integers as
// in rasterizer.cpp. Where nothing is left to be
// covered, it is not decided at all.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/cover_triangles.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>

#include "engine/render/clip.h"
#include "engine/render/coverage_mask.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kTile = CoverageMask::kTile;
constexpr std::int32_t kHalf = kSubPixels / 2;
// Triangles up to so many pixels wide and high take 32-bit edge functions, also in the tiles' other pixels:
// |E| <= 2 * (71 * 256)^2 < 2^30.
constexpr std::int32_t kSmall = 64 * kSubPixels;

// The first and last pixel whose centre lies in a closed interval of sub-pixels.
constexpr std::int32_t first_pixel(std::int32_t at) {
  return (at + kHalf - 1) >> kSubPixelBits;
}
constexpr std::int32_t last_pixel(std::int32_t at) {
  return (at - kHalf) >> kSubPixelBits;
}

// An edge of a triangle whose corners are clockwise as seen. Inside is >= 0: the bias takes the zero away
// from edges that are neither left nor top ones.
template <class Int>
struct Edge {
  Int at;     // at the centre of a first pixel
  Int right;  // what a pixel further changes
  Int down;

  Edge(const ScreenVertex& a, const ScreenVertex& b, std::int32_t x, std::int32_t y) {
    const Int dx = Int{b.x} - a.x;
    const Int dy = Int{b.y} - a.y;
    const Int bias = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
    at = dx * (Int{y} * kSubPixels + kHalf - a.y) - dy * (Int{x} * kSubPixels + kHalf - a.x) + bias;
    right = -dy * kSubPixels;
    down = dx * kSubPixels;
  }
};

struct Pixels {
  std::int32_t x0;
  std::int32_t y0;
  std::int32_t x1;  // the last ones
  std::int32_t y1;
};

// The bits of rows y0 to y1 of a tile; the edges begin at its first pixel in row y0.
HWY_INLINE std::uint64_t tile_bits(const Edge<std::int32_t>& ea, const Edge<std::int32_t>& eb,
                                   const Edge<std::int32_t>& ec, std::int32_t y0, std::int32_t y1) {
  const hn::CappedTag<std::int32_t, kTile> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto none = hn::Set(d, -1);
  std::uint64_t bits = 0;
  for (std::int32_t x = 0; x < kTile; x += lanes) {
    const auto along = hn::Iota(d, x);
    auto a = hn::Add(hn::Set(d, ea.at), hn::Mul(along, hn::Set(d, ea.right)));
    auto b = hn::Add(hn::Set(d, eb.at), hn::Mul(along, hn::Set(d, eb.right)));
    auto c = hn::Add(hn::Set(d, ec.at), hn::Mul(along, hn::Set(d, ec.right)));
    const auto down_a = hn::Set(d, ea.down);
    const auto down_b = hn::Set(d, eb.down);
    const auto down_c = hn::Set(d, ec.down);
    for (std::int32_t y = y0; y <= y1; ++y) {
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, hn::Gt(hn::Or(hn::Or(a, b), c), none), bytes);
      bits |= static_cast<std::uint64_t>(bytes[0]) << static_cast<unsigned>(kTile * (y % kTile) + x);
      a = hn::Add(a, down_a);
      b = hn::Add(b, down_b);
      c = hn::Add(c, down_c);
    }
  }
  return bits;
}

void cover_small(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, const Pixels& box,
                 CoverageMask& into) {
  for (std::int32_t row = box.y0 / kTile; row <= box.y1 / kTile; ++row) {
    const std::int32_t y0 = std::max(box.y0, row * kTile);
    const std::int32_t y1 = std::min(box.y1, row * kTile + kTile - 1);
    for (std::int32_t column = box.x0 / kTile; column <= box.x1 / kTile; ++column) {
      const PixelRect part{std::max(box.x0, column * kTile), y0,
                           std::min(box.x1, column * kTile + kTile - 1) + 1, y1 + 1};
      if ((CoverageMask::bits_in_tile(part) & ~into.tile_at(column, row)) == 0) continue;
      const Edge<std::int32_t> ea(b, c, column * kTile, y0);
      const Edge<std::int32_t> eb(c, a, column * kTile, y0);
      const Edge<std::int32_t> ec(a, b, column * kTile, y0);
      into.add(column, row, tile_bits(ea, eb, ec, y0, y1));
    }
  }
}

constexpr std::int64_t floor_divided(std::int64_t a, std::int64_t positive) {
  return a >= 0 ? a / positive : -((-a + positive - 1) / positive);
}

// Narrows [x0, x1] to the pixels of this row inside the edge.
void narrow(const Edge<std::int64_t>& edge, std::int64_t at_row, std::int64_t& x0, std::int64_t& x1) {
  if (edge.right > 0) {
    x0 = std::max(x0, -floor_divided(at_row, edge.right));
  } else if (edge.right < 0) {
    x1 = std::min(x1, floor_divided(at_row, -edge.right));
  } else if (at_row < 0) {
    x1 = x0 - 1;
  }
}

void cover_large(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, const Pixels& box,
                 CoverageMask& into) {
  const Edge<std::int64_t> ea(b, c, 0, box.y0);
  const Edge<std::int64_t> eb(c, a, 0, box.y0);
  const Edge<std::int64_t> ec(a, b, 0, box.y0);
  for (std::int32_t y = box.y0; y <= box.y1; ++y) {
    const std::int64_t down = y - box.y0;
    std::int64_t from = box.x0;
    std::int64_t to = box.x1;
    narrow(ea, ea.at + ea.down * down, from, to);
    narrow(eb, eb.at + eb.down * down, from, to);
    narrow(ec, ec.at + ec.down * down, from, to);
    if (from <= to) into.fill({static_cast<int>(from), y, static_cast<int>(to) + 1, y + 1});
  }
}

void cover_triangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, CoverageMask& into) {
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const Pixels box{std::max(first_pixel(left), 0), std::max(first_pixel(top), 0),
                   std::min(last_pixel(right), into.width() - 1),
                   std::min(last_pixel(bottom), into.height() - 1)};
  if (box.x0 > box.x1 || box.y0 > box.y1) return;
  if (right - left <= kSmall && bottom - top <= kSmall) {
    const std::int32_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area > 0) cover_small(a, b, c, box, into);
    if (area < 0) cover_small(a, c, b, box, into);
  } else {
    const std::int64_t area = (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
                              (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
    if (area > 0) cover_large(a, b, c, box, into);
    if (area < 0) cover_large(a, c, b, box, into);
  }
}

void cover_mesh(const Matrix4& view_projection, std::span<const Vec3f> positions,
                std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
                CoverageMask& into) {
  for (const TriangleIndices& corners : triangles) {
    const ScreenVertex& a = vertices[static_cast<std::size_t>(corners[0])];
    const ScreenVertex& b = vertices[static_cast<std::size_t>(corners[1])];
    const ScreenVertex& c = vertices[static_cast<std::size_t>(corners[2])];
    if ((a.outside | b.outside | c.outside) == 0) {
      cover_triangle(a, b, c, into);
    } else if ((a.outside & b.outside & c.outside) == 0) {
      const auto clip = [&](std::int32_t v) {
        return transformed(view_projection, Vec3(positions[static_cast<std::size_t>(v)]));
      };
      const ClippedFan fan =
          clipped_fan(clip(corners[0]), clip(corners[1]), clip(corners[2]), into.width(), into.height());
      for (int n = 2; n < fan.count; ++n) {
        cover_triangle(fan.corners[0], fan.corners[static_cast<std::size_t>(n - 1)],
                       fan.corners[static_cast<std::size_t>(n)], into);
      }
    }
  }
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "storage/base/error.h"

namespace footwall::render {
namespace {

HWY_EXPORT(cover_triangle);
HWY_EXPORT(cover_mesh);

}  // namespace

void cover_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, CoverageMask& into) {
  HWY_DYNAMIC_DISPATCH(cover_triangle)(a, b, c, into);
}

void cover(const Matrix4& view_projection, std::span<const Vec3f> positions,
           std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
           CoverageMask& into) {
  require(positions.size() == vertices.size(), "one projected vertex per position");
  HWY_DYNAMIC_DISPATCH(cover_mesh)(view_projection, positions, vertices, triangles, into);
}

}  // namespace footwall::render
#endif
