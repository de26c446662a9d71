#include "engine/voxelize/detail/pixel_columns.h"

#include <algorithm>
#include <cmath>

#include "engine/voxelize/detail/bresenham.h"

namespace footwall::voxelize::detail {
namespace {

void rasterize(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
               std::vector<EdgePixels>& edge) {
  bresenham(x0, y0, x1, y1, [&](std::int64_t x, std::int64_t y) {
    EdgePixels& pixels = edge[static_cast<std::size_t>(x)];
    const auto at = static_cast<std::int32_t>(y);
    if (pixels.lo > pixels.hi) {
      pixels = {at, at};
    } else {
      pixels = {std::min(pixels.lo, at), std::max(pixels.hi, at)};
    }
  });
}

bool inside(const survey::Box& box, const Voxel& voxel) {
  return box.contains({voxel[0], voxel[1], voxel[2]});
}

// The y for which the position at x may lie in the box, with a pixel to spare on both sides; the spare is far
// above the error of these doubles unless the position hardly changes, and then every y is kept.
void narrow(const FlatTriangle& flat, const survey::Box& box, double x, double& from, double& to) {
  constexpr double kSteep = 1e-6;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double slope = flat.along_y[axis];
    if (std::abs(slope) < kSteep) continue;
    const double start = flat.position(axis, x, 0);
    double enters = (static_cast<double>(box.lo[axis]) - 0.5 - start) / slope;
    double leaves = (static_cast<double>(box.hi[axis]) - 0.5 - start) / slope;
    if (slope < 0) std::swap(enters, leaves);
    from = std::max(from, std::floor(enters) - 1);
    to = std::min(to, std::ceil(leaves) + 2);
  }
}

}  // namespace

void rasterize(const FlatTriangle& flat, Edges& edges) {
  const auto width = static_cast<std::size_t>(flat.x3 + 1);
  edges.edge12.assign(width, {});
  edges.edge23.assign(width, {});
  rasterize(0, 0, flat.x2, flat.y2, edges.edge12);
  rasterize(flat.x2, flat.y2, flat.x3, 0, edges.edge23);
}

std::int64_t columns_below(const Edges& edges, const FlatTriangle& flat, const survey::Box& box,
                           std::vector<PixelColumn>& columns) {
  const std::size_t width = edges.edge12.size();
  columns.resize(width);
  std::int64_t total = 0;
  for (std::size_t x = 0; x < width; ++x) {
    const EdgePixels& one = edges.edge12[x];
    const EdgePixels& two = edges.edge23[x];
    // Every x has a pixel of one of the two.
    const std::int32_t lc = one.lo > one.hi ? two.lo : two.lo > two.hi ? one.lo : std::min(one.lo, two.lo);
    double from = 0;
    double to = lc;
    narrow(flat, box, static_cast<double>(x), from, to);
    PixelColumn& column = columns[x];
    column = {0, 0, total};
    if (from >= to) continue;
    auto first = static_cast<std::int32_t>(from);
    auto last = static_cast<std::int32_t>(to);
    const auto at = static_cast<std::int64_t>(x);
    while (first < last && !inside(box, flat.voxel(at, first))) ++first;
    while (first < last && !inside(box, flat.voxel(at, last - 1))) --last;
    column = {first, last, total};
    total += column.size();
  }
  return total;
}

}  // namespace footwall::voxelize::detail
