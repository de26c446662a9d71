// What is known of a triangle before its first row: axes, columns inside the clip box, and all bounds, still
// exact.
#pragma once
#include <cstdint>

#include "engine/voxelize/detail/lines.h"
#include "engine/voxelize/detail/plane.h"
#include "storage/survey/box.h"

namespace footwall::voxelize::detail {

struct Axes {
  int u = 2;
  int v = 1;
  int w = 0;
};
// w is the axis along which the normal is longest (the lowest number among equals; without area the axis of
// the greatest extent), u the sample axis unless that is w, then the crossline axis.
Axes axes_of(const Corners& corners, const std::array<Int128, 3>& normal);

struct Setup {
  int u_axis = 2;
  int v_axis = 1;
  int w_axis = 0;
  survey::Box box;         // bounding box in voxels, clipped; nothing else is set where it is empty
  Lines u_of_v;            // edges seen along w: which columns of a row
  Lines w_of_u;            // edges seen along v
  Lines w_of_v;            // edges seen along u
  bool has_plane = false;  // false for segments and points: their edges say it all
  Plane plane;
  bool cut_in_w = false;  // the box cuts the plane's depths, and band says which columns are left
  DepthBand band;

  std::int64_t u0() const { return box.lo[u_axis]; }
  std::int64_t v0() const { return box.lo[v_axis]; }
  std::int64_t columns_u() const { return box.size(u_axis); }
  std::int64_t columns_v() const { return box.size(v_axis); }
};

// The voxels whose closed cubes meet the triangle's bounding box.
survey::Box bounding_voxels(const Corners& corners);

Setup setup_of(const survey::LatticeTriangle& triangle, const survey::Box& clip);

}  // namespace footwall::voxelize::detail
