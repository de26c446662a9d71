#include "engine/tasks/chart_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

struct Point {
  double x = 0, y = 0;
};

Point in_chart(const pillars::Chart& chart, const survey::LatticePoint& corner) {
  const pillars::ChartPoint at = chart.from_index(survey::Lattice::index_of(corner));
  return {at.strike, at.dip};
}

// Twice the signed area of a, b, p. The same number but for its sign when a and b change places, so that a
// centre on an edge between two triangles is never in neither.
double side(const Point& a, const Point& b, const Point& p) {
  const bool turned = b.x < a.x || (b.x == a.x && b.y < a.y);
  const Point& from = turned ? b : a;
  const Point& to = turned ? a : b;
  const double area = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  return turned ? -area : area;
}

bool holds(const std::array<Point, 3>& corners, const Point& p) {
  const double a = side(corners[0], corners[1], p);
  const double b = side(corners[1], corners[2], p);
  const double c = side(corners[2], corners[0], p);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

double metres_along(const survey::Geometry& survey, const pillars::Vector3& axis, double velocity) {
  const survey::WorldPoint from = survey.world_of({0, 0, 0});
  const survey::WorldPoint to = survey.world_of({axis[0], axis[1], axis[2]});
  const double across = survey.horizontal_metres(std::hypot(to.x - from.x, to.y - from.y));
  return std::hypot(across, survey.vertical_metres(to.z - from.z, velocity));
}

}  // namespace

ChartScale chart_scale(const survey::Geometry& survey, const pillars::Chart& chart, double velocity) {
  return {metres_along(survey, chart.strike, velocity), metres_along(survey, chart.dip, velocity)};
}

pillars::Chart mean_plane(std::span<const survey::LatticeTriangle> triangles) {
  pillars::PillarInput all;
  all.id = 1;
  for (const survey::LatticeTriangle& triangle : triangles) {
    for (const survey::LatticePoint& corner : triangle)
      all.nodes.push_back(survey::Lattice::index_of(corner));
  }
  return pillars::fit_chart(std::span(&all, 1));
}

ChartRaster raster_over(const pillars::Chart& chart,
                        std::span<const std::span<const survey::LatticeTriangle>> triangles, double cell,
                        std::int64_t most) {
  require(cell > 0 && std::isfinite(cell) && most >= 1, "a raster needs cells of a size, and room for one");
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar}, high{-kFar, -kFar};
  for (const auto& some : triangles) {
    for (const survey::LatticeTriangle& triangle : some) {
      for (const survey::LatticePoint& corner : triangle) {
        const Point p = in_chart(chart, corner);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
  }
  ChartRaster raster;
  raster.chart = chart;
  raster.cell = cell;
  if (low.x > high.x) return raster;
  for (;; raster.cell *= 2) {
    const auto first = [&](double at) { return std::floor(at / raster.cell); };
    const auto last = [&](double at) { return std::ceil(at / raster.cell); };
    const double columns = last(high.x) - first(low.x) + 1, rows = last(high.y) - first(low.y) + 1;
    if (columns * rows > static_cast<double>(most) && columns * rows > 4) continue;
    raster.strike0 = first(low.x) * raster.cell;
    raster.dip0 = first(low.y) * raster.cell;
    raster.columns = static_cast<std::int64_t>(columns);
    raster.rows = static_cast<std::int64_t>(rows);
    return raster;
  }
}

std::vector<std::int32_t> covering_faces(const ChartRaster& raster,
                                         std::span<const survey::LatticeTriangle> triangles,
                                         const JobContext& job) {
  std::vector<std::int32_t> faces(raster.cells(), -1);
  const auto cells_between = [&](double low, double high, double zero, std::int64_t count) {
    // One more on either side: the test of the centre decides.
    const auto clamped = [&](double at) { return std::clamp(at, -1.0, static_cast<double>(count)); };
    const auto from = static_cast<std::int64_t>(clamped(std::floor((low - zero) / raster.cell) - 1));
    const auto to = static_cast<std::int64_t>(clamped(std::ceil((high - zero) / raster.cell) + 1));
    return std::pair(std::max<std::int64_t>(from, 0), std::min(to, count - 1));
  };
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (f % 4096 == 0) {
      job.report(static_cast<double>(f) / static_cast<double>(triangles.size()), "raster");
      job.check();
    }
    std::array<Point, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = in_chart(raster.chart, triangles[f][c]);
    const auto [x_low, x_high] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [y_low, y_high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto [first_column, last_column] = cells_between(x_low, x_high, raster.strike0, raster.columns);
    const auto [first_row, last_row] = cells_between(y_low, y_high, raster.dip0, raster.rows);
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      for (std::int64_t column = first_column; column <= last_column; ++column) {
        std::int32_t& face = faces[static_cast<std::size_t>(row * raster.columns + column)];
        if (face >= 0) continue;
        const Point centre{raster.strike0 + static_cast<double>(column) * raster.cell,
                           raster.dip0 + static_cast<double>(row) * raster.cell};
        if (holds(corners, centre)) face = static_cast<std::int32_t>(f);
      }
    }
  }
  return faces;
}

}  // namespace footwall::tasks
