// A fault seen along the normal of its chart: cells of equal size over its triangles, and which face covers
// which cell. Two triangulations of one fault meet here, face by face or not.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/pillars/chart.h"
#include "storage/base/job_context.h"
#include "storage/survey/geometry.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {

// Cell (column, row) is centred on (strike, dip) = (strike0 + column * cell, dip0 + row * cell), in voxels of
// the chart. Cells lie row by row.
struct ChartRaster {
  pillars::Chart chart;
  double cell = 1;  // voxels
  double strike0 = 0, dip0 = 0;
  std::int64_t columns = 0, rows = 0;

  std::size_t cells() const { return static_cast<std::size_t>(columns * rows); }
};

// Metres of one voxel along the chart's axes; a time survey needs a velocity in m/s.
struct ChartScale {
  double strike = 1, dip = 1;
};
ChartScale chart_scale(const survey::Geometry& survey, const pillars::Chart& chart, double velocity);

// The plane of the triangles' corners, for a fault that has no chart. Throws kInvalid where all lie on a
// line.
pillars::Chart mean_plane(std::span<const survey::LatticeTriangle> triangles);

// Centres on whole multiples of `cell`, so that two rasters of one chart fit; over all corners of the
// triangles. Cells are doubled until there are at most `most`. Empty for no triangles.
ChartRaster raster_over(const pillars::Chart& chart,
                        std::span<const std::span<const survey::LatticeTriangle>> triangles, double cell,
                        std::int64_t most = 4'000'000);

// For each cell the first triangle that holds its centre, edges included; -1 where none does.
std::vector<std::int32_t> covering_faces(const ChartRaster& raster,
                                         std::span<const survey::LatticeTriangle> triangles,
                                         const JobContext& job);

}  // namespace footwall::tasks
