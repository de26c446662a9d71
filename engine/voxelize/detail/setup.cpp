#include "engine/voxelize/detail/setup.h"

#include <algorithm>

namespace footwall::voxelize::detail {
namespace {

std::int64_t extent(const Corners& p, int axis) {
  return std::max({p[0][axis], p[1][axis], p[2][axis]}) - std::min({p[0][axis], p[1][axis], p[2][axis]});
}

}  // namespace

Axes axes_of(const Corners& corners, const std::array<Int128, 3>& normal) {
  const bool has_plane = normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
  int w = 0;
  for (int axis = 1; axis < 3; ++axis) {
    const bool longer = has_plane ? magnitude(normal[axis]) > magnitude(normal[w])
                                  : extent(corners, axis) > extent(corners, w);
    if (longer) w = axis;
  }
  const int u = w == 2 ? 1 : 2;
  return {u, 3 - u - w, w};
}

survey::Box bounding_voxels(const Corners& p) {
  constexpr std::int64_t kHalf = survey::kLatticePerVoxel / 2;
  survey::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t least = std::min({p[0][axis], p[1][axis], p[2][axis]});
    const std::int64_t most = std::max({p[0][axis], p[1][axis], p[2][axis]});
    // Voxel m fills [256 m - 128, 256 m + 128], both ends included; >> rounds down.
    box.lo[axis] = -((kHalf - least) >> 8);
    box.hi[axis] = ((most + kHalf) >> 8) + 1;
  }
  return box;
}

Setup setup_of(const survey::LatticeTriangle& triangle, const survey::Box& clip) {
  const Corners corners = corners_of(triangle);
  Setup setup;
  const survey::Box whole = bounding_voxels(corners);
  setup.box = survey::intersection(whole, clip);
  if (setup.box.empty()) return setup;

  const auto normal = normal_of(corners);
  setup.has_plane = normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
  const auto [u, v, w] = axes_of(corners, normal);
  setup.u_axis = u;
  setup.v_axis = v;
  setup.w_axis = w;
  setup.u_of_v = edge_bounds(corners, setup.v_axis, setup.u_axis);
  setup.w_of_u = edge_bounds(corners, setup.u_axis, w);
  setup.w_of_v = edge_bounds(corners, setup.v_axis, w);
  if (setup.has_plane) {
    setup.plane = plane_of(corners, normal, setup.u_axis, setup.v_axis, w);
    setup.cut_in_w = setup.box.size(w) < whole.size(w);
    if (setup.cut_in_w) setup.band = DepthBand(setup.plane, setup.box.lo[w], setup.box.hi[w] - 1);
  }
  return setup;
}

}  // namespace footwall::voxelize::detail
