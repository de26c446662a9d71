#include "engine/voxelize/detail/plane.h"

#include <algorithm>
#include <cmath>

namespace footwall::voxelize::detail {
namespace {

constexpr std::int64_t kHalfVoxel = survey::kLatticePerVoxel / 2;

// floor((start + n step) / d) for n = 0, 1, ...: one division, then additions.
class Steps {
 public:
  Steps(Int128 start, Int128 step, Int128 d) : d_(d) {
    const Int128 quotient = floor_div(start, d);
    value_ = static_cast<std::int64_t>(quotient);
    rest_ = start - quotient * d;
    const Int128 step_quotient = floor_div(step, d);
    step_ = static_cast<std::int64_t>(step_quotient);
    step_rest_ = step - step_quotient * d;
  }
  std::int32_t value() const { return static_cast<std::int32_t>(value_); }
  void advance() {
    value_ += step_;
    rest_ += step_rest_;
    if (rest_ >= d_) {
      rest_ -= d_;
      ++value_;
    }
  }

 private:
  Int128 d_;
  Int128 rest_;
  Int128 step_rest_;
  std::int64_t value_;
  std::int64_t step_;
};

}  // namespace

std::array<Int128, 3> normal_of(const Corners& p) {
  std::array<Int128, 3> normal;
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    normal[axis] = static_cast<Int128>(p[1][b] - p[0][b]) * (p[2][c] - p[1][c]) -
                   static_cast<Int128>(p[1][c] - p[0][c]) * (p[2][b] - p[1][b]);
  }
  return normal;
}

Plane plane_of(const Corners& corners, const std::array<Int128, 3>& normal, int u_axis, int v_axis,
               int w_axis) {
  const Int128 sign = normal[w_axis] < 0 ? -1 : 1;
  Plane plane;
  plane.n_u = sign * normal[u_axis];
  plane.n_v = sign * normal[v_axis];
  plane.d = sign * normal[w_axis];
  const Int128 at_corner =
      plane.n_u * corners[0][u_axis] + plane.n_v * corners[0][v_axis] + plane.d * corners[0][w_axis];
  // A cube centred at m meets the plane where |256 n.m - at_corner| <= reach.
  const Int128 reach = kHalfVoxel * (magnitude(plane.n_u) + magnitude(plane.n_v) + plane.d);
  plane.c_hi = (at_corner + reach) >> 8;
  plane.c_lo = -((reach - at_corner) >> 8) + plane.d - 1;
  return plane;
}

// As for lines (lines.cpp), with two slopes whose errors add up.
bool to_fixed(const Plane& plane, std::int64_t u0, std::int64_t columns_u, std::int64_t v0,
              std::int64_t columns_v, FixedPlane& fixed) {
  const std::int64_t reach = columns_u / 2 + columns_v / 2 + 2;
  fixed.shift = 63 - bits_of(static_cast<std::uint64_t>(reach + 4));
  const Int128 one = static_cast<Int128>(1) << fixed.shift;
  if (plane.d > one / (2 * reach + 1)) return false;
  fixed.u_mid = u0 + columns_u / 2;
  fixed.v_mid = v0 + columns_v / 2;
  const Int128 at_mid = plane.n_u * fixed.u_mid + plane.n_v * fixed.v_mid;
  const Int128 w_ref = floor_div(plane.c_lo - at_mid, plane.d);
  fixed.w_ref = static_cast<std::int32_t>(w_ref);
  const auto scaled = [&](Int128 numerator) {
    return static_cast<std::int64_t>(floor_div(numerator * one, plane.d));
  };
  fixed.slope_u = scaled(-plane.n_u);
  fixed.slope_v = scaled(-plane.n_v);
  const Int128 whole = at_mid + w_ref * plane.d;
  fixed.base_lo = scaled(plane.c_lo - whole) + 1 + reach;
  fixed.base_hi = scaled(plane.c_hi - whole) + 1 + reach;
  return true;
}

void tighten(const Plane& plane, std::int64_t u0, std::int64_t v, std::span<std::int32_t> lo,
             std::span<std::int32_t> hi) {
  const Int128 shared = plane.n_u * u0 + plane.n_v * v;
  Steps low(plane.c_lo - shared, -plane.n_u, plane.d);
  Steps high(plane.c_hi - shared, -plane.n_u, plane.d);
  for (std::size_t n = 0; n < lo.size(); ++n) {
    lo[n] = std::max(lo[n], low.value());
    hi[n] = std::min(hi[n], high.value());
    low.advance();
    high.advance();
  }
}

// A column's voxels lie within R <= 1.5 of the plane's depth at its centre; one more voxel and a column of
// slack are far above the error of these doubles for slopes above kSteep and positions below 2^26.
DepthBand::DepthBand(const Plane& plane, std::int64_t least_w, std::int64_t most_w) {
  constexpr double kSteep = 1e-4;
  constexpr double kSlack = 2.5;
  const auto d = static_cast<double>(plane.d);
  const double slope_u = -static_cast<double>(plane.n_u) / d;
  const double slope_v = -static_cast<double>(plane.n_v) / d;
  steep_ = std::abs(slope_u) > kSteep;
  if (!steep_) return;
  const auto middle = plane.c_lo + (plane.c_hi - plane.c_lo) / 2;
  const double origin = static_cast<double>(middle) / d;
  rises_ = slope_u > 0;
  per_v_ = -slope_v / slope_u;
  at_least_ = (static_cast<double>(least_w) - kSlack - origin) / slope_u;
  at_most_ = (static_cast<double>(most_w) + kSlack - origin) / slope_u;
}

void DepthBand::narrow(std::int64_t v, std::int64_t& first, std::int64_t& last) const {
  if (!steep_) return;
  const double moved = per_v_ * static_cast<double>(v);
  const double from = (rises_ ? at_least_ : at_most_) + moved - 1;
  const double to = (rises_ ? at_most_ : at_least_) + moved + 1;
  // Compared as doubles first: the band may lie anywhere.
  if (from > static_cast<double>(last) || to < static_cast<double>(first)) {
    last = first - 1;
    return;
  }
  if (from > static_cast<double>(first)) first = static_cast<std::int64_t>(std::floor(from));
  if (to < static_cast<double>(last)) last = static_cast<std::int64_t>(std::ceil(to));
}

}  // namespace footwall::voxelize::detail
