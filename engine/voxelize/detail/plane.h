// The two bounds that the triangle's plane puts on w in column (u, v): those cubes of the column that it
// cuts.
#pragma once
#include <cstdint>
#include <span>

#include "engine/voxelize/detail/lines.h"

namespace footwall::voxelize::detail {

// floor((c_lo - n_u u - n_v v) / d) <= w <= floor((c_hi - n_u u - n_v v) / d), d > 0, |n_u| and |n_v| <= d.
struct Plane {
  Int128 n_u = 0;
  Int128 n_v = 0;
  Int128 d = 1;
  Int128 c_lo = 0;
  Int128 c_hi = 0;
};

// e0 x e1 of the triangle's edges, in lattice units squared; all zero for a triangle without area.
std::array<Int128, 3> normal_of(const Corners& corners);

// The normal's w component must not be zero.
Plane plane_of(const Corners& corners, const std::array<Int128, 3>& normal, int u_axis, int v_axis,
               int w_axis);

// The plane in 64-bit fixed point, exact for all columns of a rectangle:
//   bound = w_ref + ((base + slope_u * (u - u_mid) + slope_v * (v - v_mid)) >> shift), wrapping, shift >= 32.
struct FixedPlane {
  std::int64_t u_mid = 0;
  std::int64_t v_mid = 0;
  std::int32_t w_ref = 0;
  int shift = 32;
  std::int64_t slope_u = 0;
  std::int64_t slope_v = 0;
  std::int64_t base_lo = 0;
  std::int64_t base_hi = 0;
};

// False where 64 bits do not suffice; they do for triangles of up to 2048 voxels along each axis.
bool to_fixed(const Plane& plane, std::int64_t u0, std::int64_t columns_u, std::int64_t v0,
              std::int64_t columns_v, FixedPlane& fixed);

// lo and hi of the columns u0, u0 + 1, ... of row v in 128 bits, combined with what they hold.
void tighten(const Plane& plane, std::int64_t u0, std::int64_t v, std::span<std::int32_t> lo,
             std::span<std::int32_t> hi);

// Which columns of a row the plane can reach between two depths. Only saves work, so that doubles do: it
// keeps every column with a voxel there, and a few more.
class DepthBand {
 public:
  DepthBand() = default;
  DepthBand(const Plane& plane, std::int64_t least_w, std::int64_t most_w);
  // Raises first and lowers last.
  void narrow(std::int64_t v, std::int64_t& first, std::int64_t& last) const;

 private:
  double at_least_ = 0;  // u = at_least_ + per_v_ * v where the plane comes to the least depth, less slack
  double at_most_ = 0;
  double per_v_ = 0;
  bool rises_ = false;
  bool steep_ = false;  // false: the plane hardly changes along u, and rows are kept whole
};

}  // namespace footwall::voxelize::detail
