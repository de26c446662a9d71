// Meshes of small triangles: most of them hit no pixel's centre, or one. They are sorted out one by one with
// nothing but their bounding boxes, and what is left is set up for as many triangles at once as a vector has
// lanes. Larger ones go to rasterizer.cpp; each pixel gets the same bits from either.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/triangle_batch.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "engine/render/rasterizer.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBatch = 256;
// The most lanes that a vector of int32 may have.
constexpr std::size_t kMostLanes = 16;

// Numbers of triangles, one after the other.
class Numbers {
 public:
  Numbers(std::span<const IdRun> runs, std::size_t first_triangle) : runs_(runs) {
    const auto after =
        std::upper_bound(runs.begin(), runs.end(), first_triangle,
                         [](std::size_t at, const IdRun& run) { return at < run.first_triangle; });
    run_ = static_cast<std::size_t>(after - runs.begin()) - 1;
  }
  // Of the triangles [first, first + n); first never falls.
  void fill(std::size_t first, std::size_t n, PrimitiveId* HWY_RESTRICT to) {
    while (n > 0) {
      const std::size_t end =
          run_ + 1 < runs_.size() ? runs_[run_ + 1].first_triangle : static_cast<std::size_t>(-1);
      const std::size_t here = std::min(n, end - first);
      const PrimitiveId id =
          runs_[run_].first_id + static_cast<PrimitiveId>(first - runs_[run_].first_triangle);
      for (std::size_t k = 0; k < here; ++k) to[k] = id + static_cast<PrimitiveId>(k);
      to += here;
      first += here;
      n -= here;
      if (first == end) ++run_;
    }
  }

 private:
  std::span<const IdRun> runs_;
  std::size_t run_;
};

struct Mesh {
  const Matrix4& view_projection;
  std::span<const Vec3f> positions;
  std::span<const ScreenVertex> vertices;
  std::span<const TriangleIndices> triangles;
};

HWY_INLINE void draw_alone(const Mesh& mesh, std::size_t t, PrimitiveId id, VisibilityBuffer& into) {
  const TriangleIndices& corners = mesh.triangles[t];
  const ScreenVertex& a = mesh.vertices[static_cast<std::size_t>(corners[0])];
  const ScreenVertex& b = mesh.vertices[static_cast<std::size_t>(corners[1])];
  const ScreenVertex& c = mesh.vertices[static_cast<std::size_t>(corners[2])];
  if ((a.outside | b.outside | c.outside) == 0) {
    rasterize_screen(a, b, c, id, into);
  } else if ((a.outside & b.outside & c.outside) == 0) {
    const auto clip = [&](std::int32_t v) {
      return transformed(mesh.view_projection, Vec3(mesh.positions[static_cast<std::size_t>(v)]));
    };
    rasterize_clip(clip(corners[0]), clip(corners[1]), clip(corners[2]), id, into);
  }
}

#if HWY_TARGET == HWY_SCALAR

void draw_batches(const Mesh& mesh, std::span<const IdRun> runs, const TriangleRange& range,
                  VisibilityBuffer& into) {
  Numbers numbers(runs, range.begin);
  for (std::size_t t = range.begin; t < range.end; ++t) {
    PrimitiveId id = 0;
    numbers.fill(t, 1, &id);
    draw_alone(mesh, t, id, into);
  }
}

#else

// Triangles whose boxes hold at most this many centres each way are set up together.
constexpr std::uint64_t kSmallBox = 4;
static_assert(kSubPixelBits == 8);

// What is left of a batch: corners, the first pixel of the box inside the window, how many more there are to
// the right and below.
struct Small {
  alignas(64) ScreenVertex a[kBatch + kMostLanes];
  alignas(64) ScreenVertex b[kBatch + kMostLanes];
  alignas(64) ScreenVertex c[kBatch + kMostLanes];
  alignas(64) std::int32_t first[2 * (kBatch + kMostLanes)];  // x, y
  alignas(64) std::int32_t more[2 * (kBatch + kMostLanes)];
  alignas(64) PrimitiveId id[kBatch + kMostLanes];
  std::size_t count = 0;
};

// Corners clockwise as seen; `zero` takes the 0 away from edges that are neither left nor top ones.
template <class D, class V>
struct EdgeOf {
  V at;  // E at the first pixel's centre, biased
  V bias;
  V right;  // what a pixel further changes
  V down;

  HWY_INLINE EdgeOf(D d, V ax, V ay, V bx, V by, V px, V py) {
    const V dx = hn::Sub(bx, ax);
    const V dy = hn::Sub(by, ay);
    const auto zero = hn::Zero(d);
    const auto keeps = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Gt(dx, zero)));
    bias = hn::IfThenZeroElse(keeps, hn::Set(d, -1));
    at = hn::Add(hn::Sub(hn::Mul(dx, hn::Sub(py, ay)), hn::Mul(dy, hn::Sub(px, ax))), bias);
    right = hn::ShiftLeft<kSubPixelBits>(hn::Neg(dy));
    down = hn::ShiftLeft<kSubPixelBits>(dx);
  }
};

// As fill_small() of rasterizer.cpp, for as many triangles as there are lanes.
template <class D>
HWY_INLINE void draw_group(D d, const Small& small, std::size_t at, VisibilityBuffer& into) {
  using V = hn::Vec<D>;
  const hn::RebindToFloat<D> floats;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  const auto corner = [&](const ScreenVertex* v, V& x, V& y, V& depth) HWY_ATTR {
    V outside;
    hn::LoadInterleaved4(d, &v[at].x, x, y, depth, outside);
  };
  V ax, ay, ad, bx, by, bd, cx, cy, cd, x0, y0, w, h;
  corner(small.a, ax, ay, ad);
  corner(small.b, bx, by, bd);
  corner(small.c, cx, cy, cd);
  hn::LoadInterleaved2(d, small.first + 2 * at, x0, y0);
  hn::LoadInterleaved2(d, small.more + 2 * at, w, h);
  const V zero = hn::Zero(d);

  V area = hn::Sub(hn::Mul(hn::Sub(bx, ax), hn::Sub(cy, ay)), hn::Mul(hn::Sub(by, ay), hn::Sub(cx, ax)));
  const auto turned = hn::Lt(area, zero);
  const auto swap = [&](V& p, V& q) HWY_ATTR {
    const V old = p;
    p = hn::IfThenElse(turned, q, p);
    q = hn::IfThenElse(turned, old, q);
  };
  swap(bx, cx);
  swap(by, cy);
  swap(bd, cd);
  area = hn::Abs(area);
  const V flat = hn::VecFromMask(d, hn::Eq(area, zero));

  const V half = hn::Set(d, kSubPixels / 2);
  const V px = hn::Add(hn::ShiftLeft<kSubPixelBits>(x0), half);
  const V py = hn::Add(hn::ShiftLeft<kSubPixelBits>(y0), half);
  const EdgeOf<D, V> ea(d, bx, by, cx, cy, px, py);
  const EdgeOf<D, V> eb(d, cx, cy, ax, ay, px, py);
  const EdgeOf<D, V> ec(d, ax, ay, bx, by, px, py);
  const auto near = hn::BitCast(floats, ad);
  const auto inverse = hn::Div(hn::Set(floats, 1.0F), hn::ConvertTo(floats, area));
  const auto rise_b = hn::Mul(hn::Sub(hn::BitCast(floats, bd), near), inverse);
  const auto rise_c = hn::Mul(hn::Sub(hn::BitCast(floats, cd), near), inverse);

  Visible* place[kLanes];
  const auto width = static_cast<std::size_t>(into.width());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::int32_t* first = small.first + 2 * (at + lane);
    place[lane] = into.pixels().data() + static_cast<std::size_t>(first[1] - into.first_row()) * width +
                  static_cast<std::size_t>(first[0]);
  }
  const std::int32_t most_right = hn::GetLane(hn::MaxOfLanes(d, w));
  const std::int32_t most_down = hn::GetLane(hn::MaxOfLanes(d, h));
  alignas(64) std::int32_t depths[kLanes];
  V row_a = ea.at;
  V row_b = eb.at;
  V row_c = ec.at;
  V rows_left = h;
  for (std::int32_t y = 0; y <= most_down; ++y) {
    V a = row_a;
    V b = row_b;
    V c = row_c;
    V left = w;
    for (std::int32_t x = 0; x <= most_right; ++x) {
      const V outside = hn::Or(hn::Or(hn::Or(a, b), hn::Or(c, flat)), hn::Or(left, rows_left));
      const auto inside = hn::Gt(outside, hn::Set(d, -1));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, inside, bytes);
      unsigned hits = bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
      if (hits != 0) {
        const auto weight_b = hn::ConvertTo(floats, hn::Sub(b, eb.bias));
        const auto weight_c = hn::ConvertTo(floats, hn::Sub(c, ec.bias));
        const auto rise = hn::Add(hn::Mul(weight_b, rise_b), hn::Mul(weight_c, rise_c));
        const auto depth = hn::Clamp(hn::Add(near, rise), hn::Zero(floats), hn::Set(floats, 1.0F));
        hn::Store(hn::BitCast(d, depth), d, depths);
        const std::size_t offset = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        for (; hits != 0; hits &= hits - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(hits));
          Visible& pixel = place[lane][offset];
          const Visible here =
              static_cast<Visible>(static_cast<std::uint32_t>(depths[lane])) << 32U | small.id[at + lane];
          pixel = std::min(pixel, here);
        }
      }
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
}

void draw_small(Small& small, VisibilityBuffer& into) {
  const hn::CappedTag<std::int32_t, kMostLanes> d;
  const std::size_t lanes = hn::Lanes(d);
  // The lanes behind the last triangle have no area.
  for (std::size_t n = small.count; n % lanes != 0; ++n) {
    small.a[n] = small.b[n] = small.c[n] = {};
    small.first[2 * n] = 0;
    small.first[2 * n + 1] = into.first_row();
    small.more[2 * n] = small.more[2 * n + 1] = 0;
  }
  for (std::size_t n = 0; n < small.count; n += lanes) draw_group(d, small, n, into);
  small.count = 0;
}

void draw_batches(const Mesh& mesh, std::span<const IdRun> runs, const TriangleRange& range,
                  VisibilityBuffer& into) {
  const hn::FixedTag<std::int32_t, 4> ints;  // x, y, depth, outside
  const hn::FixedTag<std::uint64_t, 2> pairs;
  constexpr std::uint64_t kNone = 0x8000000080000000;  // either difference is negative
  constexpr std::uint64_t kLarge = ~(0x0000000100000001 * (kSmallBox - 1));
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min() / 2;
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max() / 2;
  alignas(16) const std::int32_t least[4] = {0, into.first_row(), kLeast, kLeast};
  alignas(16)
      const std::int32_t most[4] = {into.width() - 1, into.first_row() + into.rows() - 1, kMost, kMost};
  const auto window_first = hn::Load(ints, least);
  const auto window_last = hn::Load(ints, most);
  const auto up = hn::Set(ints, kSubPixels / 2 - 1);
  const auto down = hn::Set(ints, kSubPixels / 2);
  const ScreenVertex* const vertices = mesh.vertices.data();

  Numbers numbers(runs, range.begin);
  Small small;
  PrimitiveId ids[kBatch];
  for (std::size_t begin = range.begin; begin < range.end; begin += kBatch) {
    const std::size_t n = std::min(kBatch, range.end - begin);
    numbers.fill(begin, n, ids);
    std::size_t count = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const TriangleIndices& corners = mesh.triangles[begin + k];
      const auto a = hn::LoadU(ints, &vertices[corners[0]].x);
      const auto b = hn::LoadU(ints, &vertices[corners[1]].x);
      const auto c = hn::LoadU(ints, &vertices[corners[2]].x);
      const auto lo = hn::Min(hn::Min(a, b), c);
      const auto hi = hn::Max(hn::Max(a, b), c);
      const auto first = hn::ShiftRight<kSubPixelBits>(hn::Add(lo, up));
      const auto last = hn::ShiftRight<kSubPixelBits>(hn::Sub(hi, down));
      const auto first_seen = hn::Max(first, window_first);
      const auto more = hn::Sub(hn::Min(last, window_last), first_seen);
      const std::uint64_t seen = hn::GetLane(hn::BitCast(pairs, more));
      const std::uint64_t whole = hn::GetLane(hn::BitCast(pairs, hn::Sub(last, first)));
      const bool is_outside = hn::ExtractLane(hi, 3) != 0;
      const bool is_small = ((whole | seen) & kLarge) == 0;
      // Kept where the next one overwrites it, unless it is counted.
      hn::Store(a, ints, &small.a[count].x);
      hn::Store(b, ints, &small.b[count].x);
      hn::Store(c, ints, &small.c[count].x);
      hn::StoreU(hn::LowerHalf(first_seen), hn::Half<decltype(ints)>(), small.first + 2 * count);
      hn::StoreU(hn::LowerHalf(more), hn::Half<decltype(ints)>(), small.more + 2 * count);
      small.id[count] = ids[k];
      count += is_small && !is_outside ? 1 : 0;
      if (is_outside || (!is_small && (seen & kNone) == 0)) draw_alone(mesh, begin + k, ids[k], into);
    }
    small.count = count;
    draw_small(small, into);
  }
}

#endif

void draw_mesh(const Matrix4& view_projection, std::span<const Vec3f> positions,
               std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
               std::span<const IdRun> runs, const TriangleRange& range, VisibilityBuffer& into) {
  draw_batches({view_projection, positions, vertices, triangles}, runs, range, into);
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "storage/base/error.h"

namespace footwall::render {
namespace {

HWY_EXPORT(draw_mesh);

}  // namespace

void rasterize(const Matrix4& view_projection, std::span<const Vec3f> positions,
               std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
               std::span<const IdRun> runs, const TriangleRange& range, VisibilityBuffer& into) {
  require(range.begin <= range.end && range.end <= triangles.size(), "a range of the mesh's triangles");
  require(!runs.empty() && runs.front().first_triangle == 0, "runs from the first triangle on");
  HWY_DYNAMIC_DISPATCH(draw_mesh)(view_projection, positions, vertices, triangles, runs, range, into);
}

void rasterize(const Matrix4& view_projection, std::span<const Vec3f> positions,
               std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
               PrimitiveId first_id, VisibilityBuffer& into) {
  const IdRun run{0, first_id};
  rasterize(view_projection, positions, vertices, triangles, std::span(&run, 1), {0, triangles.size()}, into);
}

}  // namespace footwall::render
#endif
