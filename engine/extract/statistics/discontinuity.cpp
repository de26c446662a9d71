#include "engine/extract/statistics/discontinuity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/statistics/discontinuity.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// sums = {num, den} in the fixed point's units, whole numbers; returns the largest den.
double add_windows(const Windows& windows, std::size_t n, double scale, double* sums) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> narrow;
  const auto greatest = hn::Set(d, static_cast<double>(std::numeric_limits<float>::max()));
  const auto one = hn::Set(d, 1.0);
  const auto fewest = hn::Set(d, 4.0);
  const auto factor = hn::Set(d, scale);
  auto all_num = hn::Zero(d);
  auto all_den = hn::Zero(d);
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    auto squares = hn::Zero(d);
    auto m = hn::Zero(d);
    for (std::size_t k = 0; k < kNeighbours; ++k) {
      const auto raw = hn::PromoteTo(d, hn::Load(narrow, windows.value[k] + i));
      const auto good = hn::Le(hn::Abs(raw), greatest);
      const auto v = hn::IfThenElseZero(good, raw);
      sum = hn::Add(sum, v);
      squares = hn::Add(squares, hn::Mul(v, v));
      m = hn::Add(m, hn::IfThenElseZero(good, one));
    }
    const auto enough = hn::Ge(m, fewest);
    const auto num = hn::IfThenElseZero(enough, hn::Round(hn::Mul(hn::Mul(sum, sum), factor)));
    const auto den = hn::IfThenElseZero(enough, hn::Round(hn::Mul(hn::Mul(m, squares), factor)));
    all_num = hn::Add(all_num, num);
    all_den = hn::Add(all_den, den);
    largest = hn::Max(largest, den);
  }
  sums[0] = hn::GetLane(hn::SumOfLanes(d, all_num));
  sums[1] = hn::GetLane(hn::SumOfLanes(d, all_den));
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

}  // namespace footwall::extract::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract {

HWY_EXPORT(add_windows);

double discontinuity_scale(double max_abs) {
  require(max_abs >= 0 && std::isfinite(max_abs), "a volume's largest magnitude");
  return max_abs == 0 ? 0 : std::ldexp(1.0, 40) / (81 * (max_abs * max_abs));
}

void fold_windows(Windows& windows, std::size_t n, double scale, Discontinuity& into) {
  require(n <= kWindowBlock, "a block of windows");
  constexpr std::size_t kLanes = 8;
  const std::size_t padded = (n + kLanes - 1) / kLanes * kLanes;
  for (auto& values : windows.value) {
    std::fill(values + n, values + padded, std::numeric_limits<float>::quiet_NaN());
  }
  double sums[2];
  const double largest = HWY_DYNAMIC_DISPATCH(add_windows)(windows, padded, scale, sums);
  // 2^8 whole numbers of at most 2^41 add up in a double without rounding.
  if (!(largest <= 0x1p41)) {
    throw Error(ErrorCode::kCorrupt, "a sample is larger than the volume's recorded largest magnitude",
                "the volume file was altered; import it again");
  }
  into.num += static_cast<std::int64_t>(sums[0]);
  into.den += static_cast<std::int64_t>(sums[1]);
}

double Discontinuity::value() const {
  if (den == 0) return std::numeric_limits<double>::quiet_NaN();
  // Rounding may leave num above den by a few units.
  const Int128 difference = std::max<Int128>(den - num, 0);
  return static_cast<double>(difference) / static_cast<double>(den);
}

}  // namespace footwall::extract
#endif
