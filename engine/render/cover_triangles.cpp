// Triangles into a coverage mask, eight pixels of a row at once. Coverage is decided by the edge functions
// that rasterizer.cpp draws with; where nothing is left to be covered, it is not decided at all.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/cover_triangles.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "engine/render/clip.h"
#include "engine/render/coverage_mask.h"
#include "engine/render/edge_function.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kTile = CoverageMask::kTile;
// Triangles up to so many pixels wide and high take 32-bit edge functions, also in the tiles' other pixels:
// |E| <= 2 * (71 * 256)^2 < 2^30.
constexpr std::int32_t kSmall = 64 * kSubPixels;

struct Pixels {
  std::int32_t x0;
  std::int32_t y0;
  std::int32_t x1;  // the last ones
  std::int32_t y1;
};

// The bits of rows y0 to y1 of a tile; the edges begin at its first pixel in row y0.
HWY_INLINE std::uint64_t tile_bits(const EdgeFunction<std::int32_t>& ea, const EdgeFunction<std::int32_t>& eb,
                                   const EdgeFunction<std::int32_t>& ec, std::int32_t y0, std::int32_t y1) {
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
      const EdgeFunction<std::int32_t> ea(b, c, column * kTile, y0);
      const EdgeFunction<std::int32_t> eb(c, a, column * kTile, y0);
      const EdgeFunction<std::int32_t> ec(a, b, column * kTile, y0);
      into.add(column, row, tile_bits(ea, eb, ec, y0, y1));
    }
  }
}

void cover_large(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, const Pixels& box,
                 CoverageMask& into) {
  const EdgeFunction<std::int64_t> ea(b, c, 0, box.y0);
  const EdgeFunction<std::int64_t> eb(c, a, 0, box.y0);
  const EdgeFunction<std::int64_t> ec(a, b, 0, box.y0);
  for (std::int32_t y = box.y0; y <= box.y1; ++y) {
    const std::int64_t down = y - box.y0;
    std::int64_t from = box.x0;
    std::int64_t to = box.x1;
    ea.narrow(down, from, to);
    eb.narrow(down, from, to);
    ec.narrow(down, from, to);
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
    const std::int32_t area = twice_area<std::int32_t>(a, b, c);
    if (area > 0) cover_small(a, b, c, box, into);
    if (area < 0) cover_small(a, c, b, box, into);
  } else {
    const std::int64_t area = twice_area<std::int64_t>(a, b, c);
    if (area > 0) cover_large(a, b, c, box, into);
    if (area < 0) cover_large(a, c, b, box, into);
  }
}

struct Mesh {
  const Matrix4& view_projection;
  std::span<const Vec3f> positions;
  std::span<const ScreenVertex> vertices;
};

void cover_alone(const Mesh& mesh, const TriangleIndices& corners, CoverageMask& into) {
  const ScreenVertex& a = mesh.vertices[static_cast<std::size_t>(corners[0])];
  const ScreenVertex& b = mesh.vertices[static_cast<std::size_t>(corners[1])];
  const ScreenVertex& c = mesh.vertices[static_cast<std::size_t>(corners[2])];
  if ((a.outside | b.outside | c.outside) == 0) {
    cover_triangle(a, b, c, into);
  } else if ((a.outside & b.outside & c.outside) == 0) {
    const auto clip = [&](std::int32_t v) {
      return transformed(mesh.view_projection, Vec3(mesh.positions[static_cast<std::size_t>(v)]));
    };
    const ClippedFan fan =
        clipped_fan(clip(corners[0]), clip(corners[1]), clip(corners[2]), into.width(), into.height());
    for (int n = 2; n < fan.count; ++n) {
      cover_triangle(fan.corners[0], fan.corners[static_cast<std::size_t>(n - 1)],
                     fan.corners[static_cast<std::size_t>(n)], into);
    }
  }
}

#if HWY_TARGET == HWY_SCALAR

void cover_mesh(const Mesh& mesh, std::span<const TriangleIndices> triangles, CoverageMask& into) {
  for (const TriangleIndices& corners : triangles) cover_alone(mesh, corners, into);
}

#else

// Most triangles of an isosurface have few pixel centres in their boxes, or none: those with at most this
// many each way are decided as many at once as a vector has lanes.
constexpr std::uint64_t kSmallBox = 4;
constexpr std::size_t kBatch = 256;
constexpr std::size_t kMostLanes = 16;
static_assert(kSubPixelBits == 8);

struct Batch {
  alignas(64) ScreenVertex a[kBatch + kMostLanes];
  alignas(64) ScreenVertex b[kBatch + kMostLanes];
  alignas(64) ScreenVertex c[kBatch + kMostLanes];
  alignas(64) std::int32_t first[2 * (kBatch + kMostLanes)];  // pixel of the box, x and y
  alignas(64) std::int32_t more[2 * (kBatch + kMostLanes)];   // to the right and below
  std::size_t count = 0;
};

// EdgeFunction of many triangles, from a first pixel's centre at 0, 0; the corners count from there.
template <class D, class V>
struct Edges {
  V at;
  V right;
  V down;

  HWY_INLINE Edges(D d, V ax, V ay, V bx, V by) {
    const V dx = hn::Sub(bx, ax);
    const V dy = hn::Sub(by, ay);
    const auto zero = hn::Zero(d);
    const auto keeps = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Gt(dx, zero)));
    const V bias = hn::IfThenZeroElse(keeps, hn::Set(d, -1));
    at = hn::Add(hn::Sub(hn::Mul(dy, ax), hn::Mul(dx, ay)), bias);
    right = hn::ShiftLeft<kSubPixelBits>(hn::Neg(dy));
    down = hn::ShiftLeft<kSubPixelBits>(dx);
  }
};

// Bit 4 y + x of `bits`: the pixel (x0 + x, y0 + y).
HWY_INLINE void add_small(std::uint64_t bits, std::int32_t x0, std::int32_t y0, CoverageMask& into) {
  constexpr std::uint64_t kRows = 0x01010101U;
  const auto x = static_cast<unsigned>(x0 % kTile);
  const auto y = static_cast<unsigned>(y0 % kTile);
  const int column = x0 / kTile;
  const int row = y0 / kTile;
  const std::uint64_t rows =
      (bits & 0xFU) | (bits & 0xF0U) << 4U | (bits & 0xF00U) << 8U | (bits & 0xF000U) << 12U;
  const std::uint64_t here = rows & kRows * (0xFFU >> x);
  const auto add = [&](int in_column, std::uint64_t of_tile) {
    if (of_tile == 0) return;
    into.add(in_column, row, of_tile << (kTile * y));
    if (y > kTile / 2 && of_tile >> (kTile * (kTile - y)) != 0)
      into.add(in_column, row + 1, of_tile >> (kTile * (kTile - y)));
  };
  add(column, here << x);
  if (rows != here) add(column + 1, (rows ^ here) >> (kTile - x));
}

template <class D>
HWY_INLINE void cover_group(D d, const Batch& batch, std::size_t at, CoverageMask& into) {
  using V = hn::Vec<D>;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  V x0, y0, w, h;
  hn::LoadInterleaved2(d, batch.first + 2 * at, x0, y0);
  hn::LoadInterleaved2(d, batch.more + 2 * at, w, h);
  const V half = hn::Set(d, kHalfPixel);
  const V px = hn::Add(hn::ShiftLeft<kSubPixelBits>(x0), half);
  const V py = hn::Add(hn::ShiftLeft<kSubPixelBits>(y0), half);
  const auto corner = [&](const ScreenVertex* v, V& x, V& y) HWY_ATTR {
    V depth;
    V outside;
    hn::LoadInterleaved4(d, &v[at].x, x, y, depth, outside);
    x = hn::Sub(x, px);
    y = hn::Sub(y, py);
  };
  V ax, ay, bx, by, cx, cy;
  corner(batch.a, ax, ay);
  corner(batch.b, bx, by);
  corner(batch.c, cx, cy);
  const V area =
      hn::Sub(hn::Mul(hn::Sub(bx, ax), hn::Sub(cy, ay)), hn::Mul(hn::Sub(by, ay), hn::Sub(cx, ax)));
  const auto turned = hn::Lt(area, hn::Zero(d));
  const auto swap = [&](V& p, V& q) HWY_ATTR {
    const V old = p;
    p = hn::IfThenElse(turned, q, p);
    q = hn::IfThenElse(turned, old, q);
  };
  swap(bx, cx);
  swap(by, cy);
  const V flat = hn::VecFromMask(d, hn::Eq(area, hn::Zero(d)));
  const Edges<D, V> ea(d, bx, by, cx, cy);
  const Edges<D, V> eb(d, cx, cy, ax, ay);
  const Edges<D, V> ec(d, ax, ay, bx, by);

  const std::int32_t most_right = hn::GetLane(hn::MaxOfLanes(d, w));
  const std::int32_t most_down = hn::GetLane(hn::MaxOfLanes(d, h));
  V row_a = ea.at;
  V row_b = eb.at;
  V row_c = ec.at;
  V rows_left = h;
  V bits = hn::Zero(d);
  for (std::int32_t y = 0; y <= most_down; ++y) {
    V a = row_a;
    V b = row_b;
    V c = row_c;
    V left = w;
    for (std::int32_t x = 0; x <= most_right; ++x) {
      const V outside = hn::Or(hn::Or(hn::Or(a, b), hn::Or(c, flat)), hn::Or(left, rows_left));
      const V bit = hn::Set(d, std::int32_t{1} << (4 * y + x));
      bits = hn::Or(bits, hn::AndNot(hn::BroadcastSignBit(outside), bit));
      a = hn::Add(a, ea.right);
      b = hn::Add(b, eb.right);
      c = hn::Add(c, ec.right);
      left = hn::Sub(left, hn::Set(d, 1));
    }
    row_a = hn::Add(row_a, ea.down);
    row_b = hn::Add(row_b, eb.down);
    row_c = hn::Add(row_c, ec.down);
    rows_left = hn::Sub(rows_left, hn::Set(d, 1));
  }
  alignas(64) std::int32_t hits[kLanes];
  hn::Store(bits, d, hits);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (hits[lane] == 0) continue;
    const std::int32_t* const first = batch.first + 2 * (at + lane);
    add_small(static_cast<std::uint32_t>(hits[lane]), first[0], first[1], into);
  }
}

void cover_batch(Batch& batch, CoverageMask& into) {
  const hn::CappedTag<std::int32_t, kMostLanes> d;
  const std::size_t lanes = hn::Lanes(d);
  // The lanes behind the last triangle have no area.
  for (std::size_t n = batch.count; n % lanes != 0; ++n) {
    batch.a[n] = batch.b[n] = batch.c[n] = {};
    batch.first[2 * n] = batch.first[2 * n + 1] = 0;
    batch.more[2 * n] = batch.more[2 * n + 1] = 0;
  }
  for (std::size_t n = 0; n < batch.count; n += lanes) cover_group(d, batch, n, into);
  batch.count = 0;
}

void cover_mesh(const Mesh& mesh, std::span<const TriangleIndices> triangles, CoverageMask& into) {
  const hn::FixedTag<std::int32_t, 4> ints;  // x, y, depth, outside
  const hn::FixedTag<std::uint64_t, 2> pairs;
  constexpr std::uint64_t kNone = 0x8000000080000000;  // either difference is negative
  constexpr std::uint64_t kLarge = ~(0x0000000100000001 * (kSmallBox - 1));
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max() / 2;
  alignas(16) const std::int32_t least[4] = {0, 0, -kMost, -kMost};
  alignas(16) const std::int32_t most[4] = {into.width() - 1, into.height() - 1, kMost, kMost};
  const auto picture_first = hn::Load(ints, least);
  const auto picture_last = hn::Load(ints, most);
  const auto up = hn::Set(ints, kHalfPixel - 1);
  const auto down = hn::Set(ints, kHalfPixel);
  Batch batch;
  for (const TriangleIndices& corners : triangles) {
    const auto vertex = [&](std::size_t n) HWY_ATTR {
      return hn::LoadU(ints, &mesh.vertices[static_cast<std::size_t>(corners[n])].x);
    };
    const auto a = vertex(0);
    const auto b = vertex(1);
    const auto c = vertex(2);
    const auto lo = hn::Min(hn::Min(a, b), c);
    const auto hi = hn::Max(hn::Max(a, b), c);
    const auto first = hn::ShiftRight<kSubPixelBits>(hn::Add(lo, up));
    const auto last = hn::ShiftRight<kSubPixelBits>(hn::Sub(hi, down));
    const auto first_seen = hn::Max(first, picture_first);
    const auto more = hn::Sub(hn::Min(last, picture_last), first_seen);
    const std::uint64_t seen = hn::GetLane(hn::BitCast(pairs, more));
    const std::uint64_t whole = hn::GetLane(hn::BitCast(pairs, hn::Sub(last, first)));
    const bool is_outside = hn::ExtractLane(hi, 3) != 0;
    const bool is_small = ((whole | seen) & kLarge) == 0;
    // Kept where the next one overwrites it, unless it is counted.
    const std::size_t n = batch.count;
    hn::Store(a, ints, &batch.a[n].x);
    hn::Store(b, ints, &batch.b[n].x);
    hn::Store(c, ints, &batch.c[n].x);
    hn::StoreU(hn::LowerHalf(first_seen), hn::Half<decltype(ints)>(), batch.first + 2 * n);
    hn::StoreU(hn::LowerHalf(more), hn::Half<decltype(ints)>(), batch.more + 2 * n);
    batch.count += is_small && !is_outside ? 1 : 0;
    if (is_outside || (!is_small && (seen & kNone) == 0)) cover_alone(mesh, corners, into);
    if (batch.count == kBatch) cover_batch(batch, into);
  }
  cover_batch(batch, into);
}

#endif

void cover_triangles(const Matrix4& view_projection, std::span<const Vec3f> positions,
                     std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
                     CoverageMask& into) {
  cover_mesh({view_projection, positions, vertices}, triangles, into);
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "storage/base/error.h"

namespace footwall::render {
namespace {

HWY_EXPORT(cover_triangle);
HWY_EXPORT(cover_triangles);

}  // namespace

void cover_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, CoverageMask& into) {
  HWY_DYNAMIC_DISPATCH(cover_triangle)(a, b, c, into);
}

void cover(const Matrix4& view_projection, std::span<const Vec3f> positions,
           std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
           CoverageMask& into) {
  require(positions.size() == vertices.size(), "one projected vertex per position");
  HWY_DYNAMIC_DISPATCH(cover_triangles)(view_projection, positions, vertices, triangles, into);
}

}  // namespace footwall::render
#endif
