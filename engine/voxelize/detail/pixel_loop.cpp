#include "engine/voxelize/detail/pixel_loop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/voxelize/detail/pixel_loop.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::voxelize::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Real = hn::ScalableTag<double>;
using Narrow = hn::Rebind<std::int32_t, Real>;

// position() and nearest() of rotation.h, in the same order of operations, for as many y as there are lanes.
class Axis {
 public:
  HWY_INLINE Axis(const FlatTriangle& flat, std::size_t axis, double x)
      : at_x_(hn::Set(Real(), flat.along_x[axis] * x)),
        along_y_(hn::Set(Real(), flat.along_y[axis])),
        origin_(hn::Set(Real(), flat.origin[axis])) {}
  HWY_INLINE hn::Vec<Narrow> at(hn::Vec<Real> y) const {
    const Real real;
    const hn::RebindToUnsigned<Real> bits;
    const hn::RebindToUnsigned<Narrow> low;
    const auto position = hn::Add(hn::Add(at_x_, hn::Mul(along_y_, y)), origin_);
    const auto rounded = hn::Add(position, hn::Set(real, 6755399441055744.0));  // 1.5 * 2^52
    return hn::BitCast(Narrow(), hn::TruncateTo(low, hn::BitCast(bits, rounded)));
  }

 private:
  hn::Vec<Real> at_x_;
  hn::Vec<Real> along_y_;
  hn::Vec<Real> origin_;
};

void turn_back(const FlatTriangle& flat, std::int64_t x, std::int64_t first, std::span<Voxel> out) {
  const Real real;
  const Narrow narrow;
  const std::size_t lanes = hn::Lanes(real);
  const auto px = static_cast<double>(x);
  const Axis i(flat, 0, px);
  const Axis j(flat, 1, px);
  const Axis k(flat, 2, px);
  auto y = hn::Iota(real, static_cast<double>(first));
  const auto step = hn::Set(real, static_cast<double>(lanes));
  std::size_t n = 0;
  for (; n + lanes <= out.size(); n += lanes, y = hn::Add(y, step)) {
    hn::StoreInterleaved3(i.at(y), j.at(y), k.at(y), narrow, out[n].data());
  }
  if (n == out.size()) return;
  Voxel rest[HWY_MAX_BYTES / sizeof(double)];
  hn::StoreInterleaved3(i.at(y), j.at(y), k.at(y), narrow, rest[0].data());
  std::copy_n(rest, out.size() - n, out.data() + n);
}

}  // namespace footwall::voxelize::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::voxelize::detail {

HWY_EXPORT(turn_back);

void turn_back(const FlatTriangle& flat, std::int64_t x, std::int64_t first, std::span<Voxel> out) {
  HWY_DYNAMIC_DISPATCH(turn_back)(flat, x, first, out);
}

void look_and_turn_back(const FlatTriangle& flat, const Edges& edges, std::int64_t x_first,
                        std::int64_t x_last, const survey::Box& box, std::vector<Voxel>& out) {
  for (std::int64_t x = x_first; x < x_last; ++x) {
    const EdgePixels edge12 = edges.edge12[static_cast<std::size_t>(x)];
    const EdgePixels edge23 = edges.edge23[static_cast<std::size_t>(x)];
    for (std::int64_t y = 0; y <= flat.y2; ++y) {
      if (edge12.has(y) || edge23.has(y)) break;
      const Voxel voxel = flat.voxel(x, y);
      if (box.contains({voxel[0], voxel[1], voxel[2]})) out.push_back(voxel);
    }
  }
}

}  // namespace footwall::voxelize::detail
#endif
