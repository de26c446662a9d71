// One statistic of one fault in two runs, also on different meshes: both are brought onto the fault's chart
// raster.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/tasks/chart_raster.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct CompareChoice {
  std::string fault;
  std::int64_t run_a = 0, run_b = 0;
  std::string statistic = "variance";
  double cell = 1;  // voxels; larger where there would be too many (ChartRaster says)
};

struct RunComparison {
  std::string fault, statistic, unit;
  project::RunRecord run_a, run_b;
  ChartRaster raster;
  ChartScale metres;    // of one voxel along strike and dip
  double velocity = 0;  // m/s, that heights of a time survey became metres with; 0 where none was needed
  bool assumed_velocity = false;         // the survey has none: 1 ms of two-way time counts 1 m
  std::vector<double> a, b, difference;  // one a cell; NaN: no face there, or a face without a value; B - A
  std::int64_t only_a = 0, only_b = 0, both = 0;  // cells with a value
  std::optional<double> mean, rms, largest;       // of the difference; largest by its amount, with its sign
};

// Distance of a cell's centre from the raster's first one, in metres along strike and down dip.
struct CellPlace {
  double along = 0, down = 0;
};
CellPlace place_of(const RunComparison& comparison, std::int64_t column, std::int64_t row);

// The chart is the fault's, or of its mesh; without one the mean plane of run A's faces. Throws kNotFound for
// a fault, run or statistic that is not there, kInvalid where a run does not have the fault or the project
// has no survey, kCancelled.
RunComparison compare_runs(const project::Project& project, const CompareChoice& choice,
                           const JobContext& job);

// along_m,down_m,x,y,z,a,b,difference of every cell with a value in either run; x, y, z: of the cell's centre
// on the chart's plane, in the survey's CRS and vertical unit. Undefined is empty. Throws kIo, kInvalid as
// files do.
void write_csv(const RunComparison& comparison, const survey::Geometry& survey,
               const std::filesystem::path& file);

}  // namespace footwall::tasks
