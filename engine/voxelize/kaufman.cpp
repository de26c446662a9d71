#include "engine/voxelize/kaufman.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/voxelize/detail/bresenham.h"
#include "engine/voxelize/detail/setup.h"
#include "engine/voxelize/detail/voxel_set.h"

namespace footwall::voxelize {

using detail::Corner;
using detail::Corners;
using survey::Box;

namespace {

// The edge pixels of a row at which the scan's flag is set and cleared.
struct Flanks {
  std::int32_t enter = std::numeric_limits<std::int32_t>::max();
  std::int32_t leave = std::numeric_limits<std::int32_t>::min();
};

std::int64_t rounded(std::int64_t lattice) {
  return (lattice + survey::kLatticePerVoxel / 2) >> 8;
}

Corner rounded(const Corner& p) {
  return {rounded(p[0]), rounded(p[1]), rounded(p[2])};
}

// floor((c - n_u u - n_v v) / d) is the depth nearest to the plane, halves upwards.
detail::Plane nearest_plane(const Corners& corners, const std::array<detail::Int128, 3>& normal,
                            const detail::Axes& axes) {
  detail::Plane plane = detail::plane_of(corners, normal, axes.u, axes.v, axes.w);
  const auto u = static_cast<std::size_t>(axes.u);
  const auto v = static_cast<std::size_t>(axes.v);
  const auto w = static_cast<std::size_t>(axes.w);
  const detail::Int128 at_corner =
      plane.n_u * corners[0][u] + plane.n_v * corners[0][v] + plane.d * corners[0][w];
  plane.c_lo = plane.c_hi = (at_corner + plane.d * (survey::kLatticePerVoxel / 2)) >> 8;
  return plane;
}

// The depths of a row's columns, in 64 bits where they suffice.
class DepthOfPlane {
 public:
  DepthOfPlane(const detail::Plane& plane, std::int64_t u0, std::int64_t columns_u, std::int64_t v0,
               std::int64_t columns_v)
      : plane_(plane), u0_(u0), fits_(detail::to_fixed(plane, u0, columns_u, v0, columns_v, fixed_)) {}

  void row(std::int64_t v, std::span<std::int32_t> depth) const {
    if (!fits_) {
      std::fill(depth.begin(), depth.end(), std::numeric_limits<std::int32_t>::min());
      std::vector<std::int32_t> above(depth.size(), std::numeric_limits<std::int32_t>::max());
      detail::tighten(plane_, u0_, v, depth, above);
      return;
    }
    // Unsigned: the sum may wrap on the way.
    auto sum = static_cast<std::uint64_t>(fixed_.base_lo) +
               static_cast<std::uint64_t>(fixed_.slope_u) * static_cast<std::uint64_t>(u0_ - fixed_.u_mid) +
               static_cast<std::uint64_t>(fixed_.slope_v) * static_cast<std::uint64_t>(v - fixed_.v_mid);
    for (std::int32_t& each : depth) {
      each = fixed_.w_ref + static_cast<std::int32_t>(static_cast<std::int64_t>(sum) >> fixed_.shift);
      sum += static_cast<std::uint64_t>(fixed_.slope_u);
    }
  }

 private:
  detail::Plane plane_;
  std::int64_t u0_;
  detail::FixedPlane fixed_;
  bool fits_;
};

// A triangle without area: the line of its longest edge.
std::vector<Voxel> longest_edge(const Corners& p, const Box& box) {
  std::size_t edge = 0;
  detail::Int128 longest = -1;
  for (std::size_t n = 0; n < 3; ++n) {
    detail::Int128 squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto along = static_cast<detail::Int128>(p[(n + 1) % 3][axis] - p[n][axis]);
      squared += along * along;
    }
    if (squared > longest) {
      longest = squared;
      edge = n;
    }
  }
  std::vector<Voxel> voxels;
  detail::bresenham(rounded(p[edge]), rounded(p[(edge + 1) % 3]), [&](const survey::Index& at) {
    if (!box.contains(at)) return;
    voxels.push_back({static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]),
                      static_cast<std::int32_t>(at[2])});
  });
  return voxels;
}

}  // namespace

struct Kaufman::Buffers {
  std::vector<Flanks> flanks;       // by row
  std::vector<std::int32_t> depth;  // of a row's columns
  std::vector<std::int32_t> lo;
  std::vector<std::int32_t> hi;
  detail::VoxelSet line;
};

Kaufman::Kaufman() : buffers_(std::make_unique<Buffers>()) {}
Kaufman::~Kaufman() = default;

void Kaufman::rows(const survey::LatticeTriangle& triangle, const Box& clip, RowSink& sink) {
  const Corners corners = detail::corners_of(triangle);
  Box box = survey::intersection(detail::bounding_voxels(corners), clip);
  if (box.empty()) return;
  const auto normal = detail::normal_of(corners);
  detail::Axes axes = detail::axes_of(corners, normal);
  if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) {
    // Here the axis of the greatest extent is u, so that no column holds two voxels.
    axes = {axes.w, axes.w == 0 ? 1 : 0, axes.w == 2 ? 1 : 2};
    buffers_->line.assign(longest_edge(corners, box), axes.u, axes.v, axes.w);
    buffers_->line.emit(sink);
    return;
  }
  const auto u = static_cast<std::size_t>(axes.u);
  const auto v = static_cast<std::size_t>(axes.v);
  const auto w = static_cast<std::size_t>(axes.w);

  // The bounding plane: the rectangle around the rounded vertices.
  const Corners vertices = {rounded(corners[0]), rounded(corners[1]), rounded(corners[2])};
  for (const std::size_t axis : {u, v}) {
    const auto [least, most] = std::minmax({vertices[0][axis], vertices[1][axis], vertices[2][axis]});
    box.lo[axis] = std::max(box.lo[axis], least);
    box.hi[axis] = std::min(box.hi[axis], most + 1);
  }
  if (box.empty()) return;

  std::vector<Flanks>& flanks = buffers_->flanks;
  flanks.assign(static_cast<std::size_t>(box.size(axes.v)), {});
  for (std::size_t n = 0; n < 3; ++n) {
    const Corner& from = vertices[n];
    const Corner& to = vertices[(n + 1) % 3];
    detail::bresenham(from[u], from[v], to[u], to[v], [&](std::int64_t x, std::int64_t y) {
      if (y < box.lo[v] || y >= box.hi[v]) return;
      Flanks& row = flanks[static_cast<std::size_t>(y - box.lo[v])];
      row.enter = std::min(row.enter, static_cast<std::int32_t>(x));
      row.leave = std::max(row.leave, static_cast<std::int32_t>(x));
    });
  }

  const std::int64_t columns = box.size(axes.u);
  buffers_->depth.resize(static_cast<std::size_t>(columns));
  buffers_->lo.resize(static_cast<std::size_t>(columns));
  buffers_->hi.resize(static_cast<std::size_t>(columns));
  const DepthOfPlane depth_of(nearest_plane(corners, normal, axes), box.lo[u], columns, box.lo[v],
                              box.size(axes.v));
  Row row{axes.u, axes.v, axes.w, 0, 0, {}, {}};
  for (row.v = box.lo[v]; row.v < box.hi[v]; ++row.v) {
    const Flanks& flank = flanks[static_cast<std::size_t>(row.v - box.lo[v])];
    depth_of.row(row.v, buffers_->depth);
    bool inside = flank.enter < box.lo[u] && flank.leave >= box.lo[u];
    std::size_t recorded = 0;
    for (std::int64_t n = 0; n < columns; ++n) {
      const std::int64_t at = box.lo[u] + n;
      if (at == flank.enter) inside = true;
      if (inside) {
        if (recorded == 0) row.u0 = at;
        const std::int32_t depth = buffers_->depth[static_cast<std::size_t>(n)];
        const bool kept = depth >= box.lo[w] && depth < box.hi[w];
        buffers_->lo[recorded] = depth;
        buffers_->hi[recorded++] = kept ? depth : depth - 1;
      }
      if (at == flank.leave) inside = false;
    }
    if (recorded == 0) continue;
    row.lo = {buffers_->lo.data(), recorded};
    row.hi = {buffers_->hi.data(), recorded};
    sink.row(row);
  }
}

}  // namespace footwall::voxelize
