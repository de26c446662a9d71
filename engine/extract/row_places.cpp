#include "engine/extract/row_places.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/row_places.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Wide = hn::ScalableTag<std::int64_t>;
using Narrow = hn::Rebind<std::int32_t, Wide>;

// a and factor fit 32 bits.
HWY_INLINE hn::Vec<Wide> product(hn::Vec<Wide> a, std::int32_t factor) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Wide(), hn::GetLane(a) * factor);
#else
  const hn::Repartition<std::int32_t, Wide> halves;
  return hn::MulEven(hn::BitCast(halves, a), hn::Set(halves, factor));
#endif
}

std::size_t list_places(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi,
                        std::int64_t column, const Strides& strides, std::int64_t* HWY_RESTRICT places,
                        std::int32_t& longest) {
  const Wide wide;
  const Narrow narrow;
  const std::size_t lanes = hn::Lanes(wide);
  const auto lane = hn::Iota(wide, 0);
  HWY_ALIGN std::int64_t multiples[HWY_MAX_BYTES / sizeof(std::int64_t)];
  for (std::size_t k = 0; k < lanes; ++k) multiples[k] = static_cast<std::int64_t>(k) * strides.u;
  const auto u_offsets = hn::Load(wide, multiples);
  const auto next_w = hn::Set(wide, std::int64_t{strides.w});
  auto most = hn::Zero(wide);
  std::size_t used = 0;
  // The columns n .. n + lanes - 1 without the first `done`.
  const auto take = [&](std::size_t n, const std::int32_t* from, const std::int32_t* to,
                        std::size_t done) HWY_ATTR {
    const auto first = hn::PromoteTo(wide, hn::LoadU(narrow, from));
    const auto whole = hn::Sub(hn::PromoteTo(wide, hn::LoadU(narrow, to)), first);  // length - 1
    const auto past = hn::IfThenElse(hn::Gt(hn::Set(wide, static_cast<std::int64_t>(done)), lane),
                                     hn::Set(wide, -1), whole);
    const auto at_zero = hn::Set(wide, column + static_cast<std::int64_t>(n) * strides.u);
    auto place = hn::Add(hn::Add(at_zero, u_offsets), product(first, strides.w));
    most = hn::Max(most, past);
    for (std::size_t w = 0; w < kPlacesOfColumn; ++w) {
      const auto there = hn::Gt(past, hn::Set(wide, static_cast<std::int64_t>(w) - 1));
      if (hn::AllFalse(wide, there)) break;
      used += hn::CompressStore(place, there, wide, places + used);
      place = hn::Add(place, next_w);
    }
  };
  std::size_t n = 0;
  for (; n + lanes <= lo.size(); n += lanes) take(n, lo.data() + n, hi.data() + n, 0);
  if (n < lo.size()) {
    // What lies around a row may not be read: the last columns come with some that were taken already, or,
    // in a short row, with empty ones.
    if (n > 0) {
      const std::size_t last = lo.size() - lanes;
      take(last, lo.data() + last, hi.data() + last, n - last);
    } else {
      HWY_ALIGN std::int32_t short_lo[HWY_MAX_BYTES / sizeof(std::int64_t)];
      HWY_ALIGN std::int32_t short_hi[HWY_MAX_BYTES / sizeof(std::int64_t)];
      hn::Store(hn::Zero(narrow), narrow, short_lo);
      hn::Store(hn::Set(narrow, -1), narrow, short_hi);
      for (std::size_t k = 0; k < lo.size(); ++k) {
        short_lo[k] = lo[k];
        short_hi[k] = hi[k];
      }
      take(0, short_lo, short_hi, 0);
    }
  }
  longest = std::max(longest, static_cast<std::int32_t>(hn::GetLane(hn::MaxOfLanes(wide, most))) + 1);
  return used;
}

}  // namespace footwall::extract::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract {

HWY_EXPORT(list_places);

std::size_t list_places(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi,
                        std::int64_t column, const Strides& strides, std::int64_t* places,
                        std::int32_t& longest) {
  return HWY_DYNAMIC_DISPATCH(list_places)(lo, hi, column, strides, places, longest);
}

}  // namespace footwall::extract
#endif
