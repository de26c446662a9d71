#include "engine/extract/statistics/discontinuity.h"

#include <algorithm>
#include <array>
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

// The voxels in groups of as many as a vector has floats: adds those whose windows have no null, as
// add_windows(), and lists the places of the others in `rest`, where there is room for n. Returns how many.
std::size_t add_around([[maybe_unused]] const float* data, [[maybe_unused]] const std::int64_t* shifts,
                       const std::int64_t* places, std::size_t n, [[maybe_unused]] double scale,
                       [[maybe_unused]] double* sums, [[maybe_unused]] double& largest_den,
                       std::int64_t* rest) {
  std::size_t left = 0;
  std::size_t at = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<float> f;
  const hn::Half<decltype(f)> half;
  const hn::RebindToSigned<decltype(f)> whole;
  const hn::RepartitionToWide<decltype(f)> d;
  const std::size_t lanes = hn::Lanes(f);
  const auto factor = hn::Set(d, scale);
  const auto nine = hn::Set(d, static_cast<double>(kNeighbours));
  // Above the squares of all floats, below infinity; a NaN is above nothing.
  const auto finite = hn::Set(d, 1e100);
  auto all_num = hn::Zero(d);
  auto all_den = hn::Zero(d);
  auto largest = hn::Zero(d);
  HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / sizeof(std::int32_t)];
  for (; at + lanes <= n; at += lanes) {
    const std::int64_t first = places[at];
    std::int64_t farthest = 0;
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::int64_t distance = places[at + k] - first;
      index[k] = static_cast<std::int32_t>(distance);
      farthest |= distance ^ (distance >> 63);
    }
    auto sum_low = hn::Zero(d);
    auto sum_high = hn::Zero(d);
    auto squares_low = hn::Zero(d);
    auto squares_high = hn::Zero(d);
    if (farthest <= std::numeric_limits<std::int32_t>::max()) {
      const auto from = hn::Load(whole, index);
      for (std::size_t k = 0; k < kNeighbours; ++k) {
        const auto values = hn::GatherIndex(f, data + first + shifts[k], from);
        const auto low = hn::PromoteTo(d, hn::LowerHalf(half, values));
        const auto high = hn::PromoteTo(d, hn::UpperHalf(half, values));
        sum_low = hn::Add(sum_low, low);
        sum_high = hn::Add(sum_high, high);
        squares_low = hn::Add(squares_low, hn::Mul(low, low));
        squares_high = hn::Add(squares_high, hn::Mul(high, high));
      }
    } else {
      squares_low = hn::Set(d, std::numeric_limits<double>::infinity());
    }
    const bool plain = hn::AllTrue(d, hn::And(hn::Le(squares_low, finite), hn::Le(squares_high, finite)));
    if (!plain) {
      for (std::size_t k = 0; k < lanes; ++k) rest[left++] = places[at + k];
      continue;
    }
    const auto add = [&](auto sum, auto squares) HWY_ATTR {
      all_num = hn::Add(all_num, hn::Round(hn::Mul(hn::Mul(sum, sum), factor)));
      const auto den = hn::Round(hn::Mul(hn::Mul(nine, squares), factor));
      all_den = hn::Add(all_den, den);
      largest = hn::Max(largest, den);
    };
    add(sum_low, squares_low);
    add(sum_high, squares_high);
  }
  sums[0] = hn::GetLane(hn::SumOfLanes(d, all_num));
  sums[1] = hn::GetLane(hn::SumOfLanes(d, all_den));
  largest_den = hn::GetLane(hn::MaxOfLanes(d, largest));
#endif
  for (; at < n; ++at) rest[left++] = places[at];
  return left;
}

}  // namespace footwall::extract::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract {

HWY_EXPORT(add_windows);
HWY_EXPORT(add_around);

namespace {

// 2^8 whole numbers of at most 2^41 add up in a double without rounding.
void add(const double* sums, double largest, Discontinuity& into) {
  if (!(largest <= 0x1p41)) {
    throw Error(ErrorCode::kCorrupt, "a sample is larger than the volume's recorded largest magnitude",
                "the volume file was altered; import it again");
  }
  into.num += static_cast<std::int64_t>(sums[0]);
  into.den += static_cast<std::int64_t>(sums[1]);
}

}  // namespace

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
  add(sums, largest, into);
}

void fold_around(const Surroundings& in, const std::int64_t* places, std::size_t n, double scale,
                 Windows& room, Discontinuity& into) {
  require(n <= kWindowBlock, "a block of voxels");
  std::array<std::int64_t, kNeighbours> shifts;
  for (std::size_t k = 0; k < kNeighbours; ++k) {
    shifts[k] = (static_cast<std::int64_t>(k / 3) - 1) * in.i_stride +
                (static_cast<std::int64_t>(k % 3) - 1) * in.j_stride;
  }
  double sums[2] = {0, 0};
  double largest = 0;
  std::array<std::int64_t, kWindowBlock> rest;
  const std::size_t left =
      HWY_DYNAMIC_DISPATCH(add_around)(in.data, shifts.data(), places, n, scale, sums, largest, rest.data());
  add(sums, largest, into);
  if (left == 0) return;
  for (std::size_t k = 0; k < kNeighbours; ++k) {
    for (std::size_t m = 0; m < left; ++m) room.value[k][m] = in.data[rest[m] + shifts[k]];
  }
  fold_windows(room, left, scale, into);
}

double Discontinuity::value() const {
  if (den == 0) return std::numeric_limits<double>::quiet_NaN();
  // Rounding may leave num above den by a few units.
  const Int128 difference = std::max<Int128>(den - num, 0);
  return static_cast<double>(difference) / static_cast<double>(den);
}

}  // namespace footwall::extract
#endif
