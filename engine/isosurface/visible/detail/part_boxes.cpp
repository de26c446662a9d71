#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/visible/detail/part_boxes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>

#include "engine/isosurface/visible/detail/part_boxes.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Vertices are rounded to 1/256 pixel; float32 holds places in the largest picture to 1/512.
constexpr float kMargin = 1.0F / 64;
constexpr std::size_t kPoints = 5;  // of a brick, along an axis
constexpr std::size_t kRow = 8;     // room for those along samples
constexpr std::int64_t kStep = 2;

// [a][b][c]; what is behind the fifth of a row are copies of it.
struct Grid {
  alignas(64) float at[kPoints * kPoints * kRow];
  float* row(std::size_t a, std::size_t b) { return at + (a * kPoints + b) * kRow; }
};

struct Points {
  Grid x;
  Grid y;
  Grid depth;
};

bool project(const render::Matrix4& m, const survey::Box& cells, const PictureSize& size, Points& points) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> floats;
  const std::size_t lanes = hn::Lanes(d);
  const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  alignas(64) double k[kRow];
  for (std::size_t c = 0; c < kRow; ++c) {
    const auto step = static_cast<std::int64_t>(std::min(c, kPoints - 1));
    k[c] = static_cast<double>(std::min(cells.lo[2] + kStep * step, cells.hi[2]));
  }
  const auto one = set(1);
  const auto half_width = set(0.5 * size.width);
  const auto half_height = set(0.5 * size.height);
  auto least = set(1e300);
  for (std::size_t a = 0; a < kPoints; ++a) {
    const auto i =
        static_cast<double>(std::min(cells.lo[0] + kStep * static_cast<std::int64_t>(a), cells.hi[0]));
    for (std::size_t b = 0; b < kPoints; ++b) {
      const auto j =
          static_cast<double>(std::min(cells.lo[1] + kStep * static_cast<std::int64_t>(b), cells.hi[1]));
      double row[4];
      for (std::size_t n = 0; n < 4; ++n) row[n] = m[4 * n] * i + m[4 * n + 1] * j + m[4 * n + 3];
      for (std::size_t c = 0; c < kRow; c += lanes) {
        const auto at = hn::Load(d, k + c);
        const auto x = hn::Add(set(row[0]), hn::Mul(set(m[2]), at));
        const auto y = hn::Add(set(row[1]), hn::Mul(set(m[6]), at));
        const auto z = hn::Add(set(row[2]), hn::Mul(set(m[10]), at));
        const auto w = hn::Add(set(row[3]), hn::Mul(set(m[14]), at));
        least = hn::Min(least, hn::Min(w, hn::Add(w, z)));
        const auto inverse = hn::Div(one, w);
        const auto store = [&](hn::Vec<decltype(d)> v, Grid& to)
                               HWY_ATTR { hn::Store(hn::DemoteTo(floats, v), floats, to.row(a, b) + c); };
        store(hn::Mul(hn::Add(hn::Mul(x, inverse), one), half_width), points.x);
        store(hn::Mul(hn::Sub(one, hn::Mul(y, inverse)), half_height), points.y);
        store(hn::Mul(hn::Add(hn::Mul(z, inverse), one), set(0.5)), points.depth);
      }
    }
  }
  // False for what is not a number, too; beyond float32 places are of no use.
  return hn::AllTrue(d, hn::Gt(least, set(1e-30)));
}

// Of the eight corners of each part; parts [a][b][c] as bits count them.
template <class Better>
HWY_INLINE void fold(Grid& grid, float* HWY_RESTRICT parts, Better&& better) {
  const hn::CappedTag<float, 4> d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      const float* const rows[4] = {grid.row(a, b), grid.row(a, b + 1), grid.row(a + 1, b),
                                    grid.row(a + 1, b + 1)};
      for (std::size_t c = 0; c < 4; c += lanes) {
        auto best = hn::LoadU(d, rows[0] + c);
        best = better(best, hn::LoadU(d, rows[0] + c + 1));
        for (std::size_t n = 1; n < 4; ++n) {
          best = better(best, hn::LoadU(d, rows[n] + c));
          best = better(best, hn::LoadU(d, rows[n] + c + 1));
        }
        hn::Store(best, d, parts + 16 * a + 4 * b + c);
      }
    }
  }
}

bool find_boxes(const render::Matrix4& m, const survey::Box& cells, const PictureSize& size,
                const render::DepthScale& scale, PartBoxes& into) {
  Points points;
  if (!project(m, cells, size, points)) return false;
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> ints;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const auto lesser = [](auto a, auto b) HWY_ATTR { return hn::Min(a, b); };
  const auto greater = [](auto a, auto b) HWY_ATTR { return hn::Max(a, b); };
  alignas(64) float found[64];
  const auto each = [&](std::int32_t* to, auto&& round) HWY_ATTR {
    for (std::size_t n = 0; n < 64; n += lanes)
      hn::Store(hn::ConvertTo(ints, round(hn::Load(d, found + n))), ints, to + n);
  };
  const auto held = [&](V v, int most) HWY_ATTR {
    return hn::Clamp(v, hn::Set(d, -1.0F), hn::Set(d, static_cast<float>(most) + 1));
  };
  const auto first_of = [&](int most) HWY_ATTR {
    return [&, most](V v) HWY_ATTR {
      return hn::Ceil(hn::Sub(held(hn::Sub(v, hn::Set(d, kMargin)), most), hn::Set(d, 0.5F)));
    };
  };
  const auto last_of = [&](int most) HWY_ATTR {
    return [&, most](V v) HWY_ATTR {
      return hn::Floor(hn::Sub(held(hn::Add(v, hn::Set(d, kMargin)), most), hn::Set(d, 0.5F)));
    };
  };
  const auto least = hn::Set(d, static_cast<float>(scale.least));
  const auto steps = hn::Set(d, static_cast<float>(scale.steps));
  const auto slack = static_cast<float>(render::DepthScale::kSlack * scale.steps);
  const auto depth_of = [&](float shift) HWY_ATTR {
    return [&, shift](V v) HWY_ATTR {
      const auto step = hn::Add(hn::Mul(hn::Sub(v, least), steps), hn::Set(d, shift));
      return hn::Clamp(step, hn::Zero(d), hn::Set(d, static_cast<float>(render::kOpenPixel - 1)));
    };
  };
  fold(points.x, found, lesser);
  each(into.x0, first_of(size.width));
  fold(points.x, found, greater);
  each(into.x1, last_of(size.width));
  fold(points.y, found, lesser);
  each(into.y0, first_of(size.height));
  fold(points.y, found, greater);
  each(into.y1, last_of(size.height));
  fold(points.depth, found, lesser);
  each(into.nearest, depth_of(-slack - 0.125F));
  fold(points.depth, found, greater);
  each(into.farthest, depth_of(slack + 1));
  return true;
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(find_boxes);

}  // namespace

bool find_part_boxes(const render::Matrix4& to_clip, const survey::Box& cells, const PictureSize& size,
                     const render::DepthScale& scale, PartBoxes& into) {
  return HWY_DYNAMIC_DISPATCH(find_boxes)(to_clip, cells, size, scale, into);
}

}  // namespace footwall::isosurface::detail
#endif
