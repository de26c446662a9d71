// Constrained Delaunay triangulation in the chart's plane: the only door to CGAL.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/pillars/chart.h"
#include "engine/pillars/reference.h"
#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::pillars {

using PointEdge = std::array<std::int32_t, 2>;  // two point numbers

// A bounded part of the plane between constraints.
struct Region {
  std::vector<PointEdge> rim;        // directed, the region to the left; ascending
  std::vector<PointEdge> inner;      // constraints with the region on both sides; ascending
  std::vector<std::int32_t> points;  // lone points inside
};

// The regions that the edges enclose, in the order of their rims. `edges` meet in common points only; `lone`
// names points without edges. Throws Error kInvalid if edges cross after all (rounding of near misses), or
// two points fall together.
std::vector<Region> regions_of(std::span<const ChartPoint> points, std::span<const PointEdge> edges,
                               std::span<const std::int32_t> lone, const JobContext& job);

struct FillOptions {
  double detail = 0.5;
  double max_edge = 16;
  std::size_t most_points = 5'000'000;
};

// A region's triangles: numbers below points.size() are points, p + n is added[n]. Counter-clockwise in the
// plane, ascending, each starting at its smallest number.
struct Filling {
  std::vector<ChartPoint> added;
  std::vector<std::array<std::int32_t, 3>> faces;
};

// A bound from below on the vertices that edges of max_edge add to the region: what asks for more than there
// may be is refused before the work.
double least_points(const Region& region, std::span<const ChartPoint> points, double max_edge);
// kMemory: more than FillOptions::most_points by default.
Error too_many_vertices();

// Refines the region's Delaunay triangulation, worst first, until no inner edge is longer than max_edge and
// no triangle is further than `detail` from the reference in height (reference null: only edges are split, at
// the height that the triangulation has there). Depends on nothing but the region's own points, in their
// order.
Filling fill_region(const Region& region, std::span<const ChartPoint> points, Reference* reference,
                    const FillOptions& options, const JobContext& job);

}  // namespace footwall::pillars
