#include "engine/voxelize/detail/row_loop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/voxelize/detail/row_loop.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::voxelize::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Narrow = hn::ScalableTag<std::int32_t>;
static_assert(HWY_MAX_BYTES / sizeof(std::int32_t) <= Bounds::kSlack);

// 64-bit fixed-point values that grow by a constant from lane to lane: a Slope is made once for many Ramps,
// and next() gives one vector of integer parts.
#if HWY_TARGET == HWY_SCALAR
class Slope {
 public:
  Slope(std::int64_t slope, int shift) : slope_(static_cast<std::uint64_t>(slope)), shift_(shift) {}

 private:
  friend class Ramp;
  std::uint64_t slope_;
  int shift_;
};

class Ramp {
 public:
  Ramp(const Slope& slope, std::int64_t first) : value_(first), slope_(slope) {}
  hn::Vec<Narrow> next() {
    const auto integer = static_cast<std::int32_t>(value_ >> slope_.shift_);
    value_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(value_) + slope_.slope_);
    return hn::Set(Narrow(), integer);
  }

 private:
  std::int64_t value_;
  Slope slope_;
};
#else
class Slope {
 public:
  HWY_INLINE Slope(std::int64_t slope, int shift) : shift_(shift - 32) {
    const Wide wide;
    const auto lanes = static_cast<std::uint64_t>(hn::Lanes(wide));
    const auto step = static_cast<std::uint64_t>(slope);
    HWY_ALIGN std::int64_t multiples[HWY_MAX_BYTES / sizeof(std::int64_t)];
    for (std::uint64_t lane = 0; lane < lanes; ++lane)
      multiples[lane] = static_cast<std::int64_t>(lane * step);
    by_lane_ = hn::Load(wide, multiples);
    half_ = hn::Set(wide, static_cast<std::int64_t>(lanes * step));
    step_ = hn::Add(half_, half_);
  }

 private:
  friend class Ramp;
  using Wide = hn::Repartition<std::int64_t, Narrow>;
  hn::Vec<Wide> by_lane_;
  hn::Vec<Wide> half_;
  hn::Vec<Wide> step_;
  int shift_;
};

class Ramp {
 public:
  HWY_INLINE Ramp(const Slope& slope, std::int64_t first) : step_(slope.step_), shift_(slope.shift_) {
    low_ = hn::Add(hn::Set(Slope::Wide(), first), slope.by_lane_);
    high_ = hn::Add(low_, slope.half_);
  }
  HWY_INLINE hn::Vec<Narrow> next() {
    // The integers lie in the upper halves, which are the odd 32-bit lanes.
    const Narrow narrow;
    const auto upper = hn::ConcatOdd(narrow, hn::BitCast(narrow, high_), hn::BitCast(narrow, low_));
    low_ = hn::Add(low_, step_);
    high_ = hn::Add(high_, step_);
    return hn::ShiftRightSame(upper, shift_);
  }

 private:
  hn::Vec<Slope::Wide> low_;
  hn::Vec<Slope::Wide> high_;
  hn::Vec<Slope::Wide> step_;
  int shift_;
};
#endif

std::int64_t wrapping(std::int64_t base, std::int64_t slope, std::int64_t steps) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(base) +
                                   static_cast<std::uint64_t>(slope) * static_cast<std::uint64_t>(steps));
}

void tabulate(const Lines& lines, std::int64_t first, std::int64_t count, std::int64_t least,
              std::int64_t most, Bounds& bounds) {
  const Narrow narrow;
  const auto lanes = static_cast<std::int64_t>(hn::Lanes(narrow));
  bounds.make_room(count);
  std::int32_t* HWY_RESTRICT lo = bounds.lo.data();
  std::int32_t* HWY_RESTRICT hi = bounds.hi.data();
  std::fill_n(lo, count, static_cast<std::int32_t>(least));
  std::fill_n(hi, count, static_cast<std::int32_t>(most));
  for (int n = 0; n < lines.size; ++n) {
    const Line& line = lines.line[n];
    FixedLine fixed;
    if (!to_fixed(line, first, count, fixed)) {
      tighten(line, first, {lo, static_cast<std::size_t>(count)}, {hi, static_cast<std::size_t>(count)});
      continue;
    }
    Ramp ramp(Slope(fixed.slope, fixed.shift), wrapping(fixed.base, fixed.slope, first - fixed.x_mid));
    const auto ref = hn::Set(narrow, fixed.y_ref);
    for (std::int64_t x = 0; x < count; x += lanes) {
      const auto bound = hn::Add(ramp.next(), ref);
      if (line.upper) {
        hn::StoreU(hn::Min(hn::LoadU(narrow, hi + x), bound), narrow, hi + x);
      } else {
        hn::StoreU(hn::Max(hn::LoadU(narrow, lo + x), bound), narrow, lo + x);
      }
    }
  }
}

// The spans of the row's columns, the plane in fixed point; table_lo and table_hi begin at its first column.
HWY_INLINE void fixed_row(const FixedPlane& plane, const Slope& slope, const Row& row, std::int32_t least,
                          std::int32_t most, const std::int32_t* HWY_RESTRICT table_lo,
                          const std::int32_t* HWY_RESTRICT table_hi, std::int32_t* HWY_RESTRICT lo,
                          std::int32_t* HWY_RESTRICT hi) {
  const Narrow narrow;
  const auto lanes = hn::Lanes(narrow);
  const std::int64_t moved =
      wrapping(wrapping(0, plane.slope_u, row.u0 - plane.u_mid), plane.slope_v, row.v - plane.v_mid);
  Ramp low(slope, wrapping(plane.base_lo, 1, moved));
  Ramp high(slope, wrapping(plane.base_hi, 1, moved));
  const auto ref = hn::Set(narrow, plane.w_ref);
  const auto row_least = hn::Set(narrow, least);
  const auto row_most = hn::Set(narrow, most);
  const std::size_t count = row.lo.size();
  for (std::size_t n = 0; n < count; n += lanes) {
    const auto from = hn::Max(hn::LoadU(narrow, table_lo + n), row_least);
    const auto to = hn::Min(hn::LoadU(narrow, table_hi + n), row_most);
    hn::StoreU(hn::Max(from, hn::Add(low.next(), ref)), narrow, lo + n);
    hn::StoreU(hn::Min(to, hn::Add(high.next(), ref)), narrow, hi + n);
  }
}

// The same without fixed point: for planes that need 128 bits, and for segments and points.
void wide_row(const Setup& setup, const Row& row, std::int32_t least, std::int32_t most,
              const std::int32_t* table_lo, const std::int32_t* table_hi, std::int32_t* lo,
              std::int32_t* hi) {
  const std::size_t count = row.lo.size();
  for (std::size_t n = 0; n < count; ++n) {
    lo[n] = std::max(table_lo[n], least);
    hi[n] = std::min(table_hi[n], most);
  }
  if (setup.has_plane) tighten(setup.plane, row.u0, row.v, {lo, count}, {hi, count});
}

void emit_rows(const Setup& setup, RowBuffers& buffers, RowSink& sink) {
  const std::int64_t u0 = setup.u0();
  const std::int64_t v0 = setup.v0();
  const std::int64_t columns_u = setup.columns_u();
  const std::int64_t columns_v = setup.columns_v();
  const survey::Box& box = setup.box;
  const int u_axis = setup.u_axis;
  const int w_axis = setup.w_axis;
  tabulate(setup.u_of_v, v0, columns_v, box.lo[u_axis], box.hi[u_axis] - 1, buffers.u_of_v);
  tabulate(setup.w_of_v, v0, columns_v, box.lo[w_axis], box.hi[w_axis] - 1, buffers.w_of_v);
  tabulate(setup.w_of_u, u0, columns_u, box.lo[w_axis], box.hi[w_axis] - 1, buffers.w_of_u);
  buffers.columns.make_room(columns_u);
  FixedPlane fixed;
  const bool fits = setup.has_plane && to_fixed(setup.plane, u0, columns_u, v0, columns_v, fixed);
  const Slope slope(fixed.slope_u, fixed.shift);

  std::int32_t* lo = buffers.columns.lo.data();
  std::int32_t* hi = buffers.columns.hi.data();
  Row row{u_axis, setup.v_axis, w_axis, 0, 0, {}, {}};
  for (std::int64_t n = 0; n < columns_v; ++n) {
    row.v = v0 + n;
    std::int64_t first = buffers.u_of_v.lo[n];
    std::int64_t last = buffers.u_of_v.hi[n];
    const std::int32_t least = buffers.w_of_v.lo[n];
    const std::int32_t most = buffers.w_of_v.hi[n];
    if (setup.cut_in_w) setup.band.narrow(row.v, first, last);
    if (first > last || least > most) continue;
    const std::int32_t* table_lo = buffers.w_of_u.lo.data() + (first - u0);
    const std::int32_t* table_hi = buffers.w_of_u.hi.data() + (first - u0);
    row.u0 = first;
    row.lo = {lo, static_cast<std::size_t>(last - first + 1)};
    row.hi = {hi, row.lo.size()};
    if (fits) {
      fixed_row(fixed, slope, row, least, most, table_lo, table_hi, lo, hi);
    } else {
      wide_row(setup, row, least, most, table_lo, table_hi, lo, hi);
    }
    sink.row(row);
  }
}

const char* target_in_use() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace footwall::voxelize::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::voxelize::detail {

HWY_EXPORT(emit_rows);
HWY_EXPORT(target_in_use);

const char* target_in_use() {
  return HWY_DYNAMIC_DISPATCH(target_in_use)();
}

void Bounds::make_room(std::int64_t count) {
  const auto size = static_cast<std::size_t>(count) + kSlack;
  if (lo.size() >= size) return;
  lo.resize(size);
  hi.resize(size);
}

void emit_rows(const Setup& setup, RowBuffers& buffers, RowSink& sink) {
  HWY_DYNAMIC_DISPATCH(emit_rows)(setup, buffers, sink);
}

}  // namespace footwall::voxelize::detail
#endif
