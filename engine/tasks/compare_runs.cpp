#include "engine/tasks/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kMillisecondIsMetre = 2000;  // m/s of two-way time, as in the scene

project::FaultRun fault_in(const project::Project& project, const project::RunRecord& run,
                           const project::FaultRecord& fault, const std::string& statistic) {
  const std::vector<std::int64_t> faults = project.run_faults(run.id);
  if (std::ranges::find(faults, fault.id) == faults.end()) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("run {} ({}) does not have fault {}", run.id, run.name, fault.name),
                "choose another run or fault");
  }
  project::FaultRun stored = project.fault_statistics(run.id, fault.id);
  if (!stored.statistics.contains(statistic)) {
    std::vector<std::string> names;
    for (const auto& [name, values] : stored.statistics) names.push_back(name);
    throw Error(ErrorCode::kNotFound,
                fmt::format("run {} ({}) has no {} of fault {}", run.id, run.name, statistic, fault.name),
                fmt::format("it has {}", fmt::join(names, ", ")));
  }
  return stored;
}

pillars::Chart chart_of(const project::Project& project, const project::FaultRecord& fault,
                        std::span<const survey::LatticeTriangle> triangles) {
  project::Bytes bytes = fault.chart;
  if (bytes.empty()) {
    if (const auto mesh = project.mesh(fault.id)) bytes = mesh->chart;
  }
  if (bytes.empty()) return mean_plane(triangles);
  return pillars::Chart::from_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<double> values_on(const ChartRaster& raster, const project::FaultRun& run,
                              const std::string& statistic, const JobContext& job) {
  const std::vector<double>& of_faces = run.statistics.at(statistic);
  std::vector<double> values;
  values.reserve(raster.cells());
  for (const std::int32_t face : covering_faces(raster, run.lattice, job))
    values.push_back(face < 0 ? kUndefined : of_faces[static_cast<std::size_t>(face)]);
  return values;
}

void sum_up(RunComparison& comparison) {
  double sum = 0, squares = 0, largest = 0;
  comparison.difference.resize(comparison.a.size(), kUndefined);
  for (std::size_t cell = 0; cell < comparison.a.size(); ++cell) {
    const bool in_a = std::isfinite(comparison.a[cell]), in_b = std::isfinite(comparison.b[cell]);
    comparison.only_a += in_a && !in_b;
    comparison.only_b += in_b && !in_a;
    if (!in_a || !in_b) continue;
    const double difference = comparison.difference[cell] = comparison.b[cell] - comparison.a[cell];
    ++comparison.both;
    sum += difference;
    squares += difference * difference;
    if (std::abs(difference) > std::abs(largest)) largest = difference;
  }
  if (comparison.both == 0) return;
  const auto cells = static_cast<double>(comparison.both);
  comparison.mean = sum / cells;
  comparison.rms = std::sqrt(squares / cells);
  comparison.largest = largest;
}

void set_metres(RunComparison& comparison, const project::Project& project, const survey::Geometry& survey) {
  const bool in_time = survey.vertical_unit == survey::VerticalUnit::kMillisecond;
  if (in_time) {
    const auto stored = project.setting("velocity");
    const auto known = stored ? text::number(*stored) : std::nullopt;
    comparison.assumed_velocity = !known || !(*known > 0);
    comparison.velocity = comparison.assumed_velocity ? kMillisecondIsMetre : *known;
  }
  comparison.metres = chart_scale(survey, comparison.raster.chart, comparison.velocity);
}

}  // namespace

CellPlace place_of(const RunComparison& comparison, std::int64_t column, std::int64_t row) {
  return {static_cast<double>(column) * comparison.raster.cell * comparison.metres.strike,
          static_cast<double>(row) * comparison.raster.cell * comparison.metres.dip};
}

RunComparison compare_runs(const project::Project& project, const CompareChoice& choice,
                           const JobContext& job) {
  const survey::Geometry survey = required_survey(project, "the comparison of runs");
  const project::FaultRecord fault = project.fault(choice.fault);
  RunComparison comparison;
  comparison.fault = fault.name;
  comparison.statistic = choice.statistic;
  comparison.run_a = project.run(choice.run_a);
  comparison.run_b = project.run(choice.run_b);
  const project::FaultRun a = fault_in(project, comparison.run_a, fault, choice.statistic);
  const project::FaultRun b = fault_in(project, comparison.run_b, fault, choice.statistic);
  for (const project::StatisticRecord& one : known_statistics(project)) {
    if (one.name == choice.statistic) comparison.unit = unit_of(one);
  }
  const std::array<std::span<const survey::LatticeTriangle>, 2> triangles{a.lattice, b.lattice};
  comparison.raster = raster_over(chart_of(project, fault, a.lattice), triangles, choice.cell);
  set_metres(comparison, project, survey);
  comparison.a = values_on(comparison.raster, a, choice.statistic, job.part(0, 0.5));
  comparison.b = values_on(comparison.raster, b, choice.statistic, job.part(0.5, 1));
  sum_up(comparison);
  return comparison;
}

void write_csv(const RunComparison& comparison, const survey::Geometry& survey,
               const std::filesystem::path& file) {
  std::string table = "along_m,down_m,x,y,z,a,b,difference\n";
  const ChartRaster& raster = comparison.raster;
  for (std::int64_t row = 0; row < raster.rows; ++row) {
    for (std::int64_t column = 0; column < raster.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * raster.columns + column);
      if (!std::isfinite(comparison.a[cell]) && !std::isfinite(comparison.b[cell])) continue;
      const CellPlace place = place_of(comparison, column, row);
      const survey::WorldPoint at =
          survey.world_of(raster.chart.to_index({raster.strike0 + static_cast<double>(column) * raster.cell,
                                                 raster.dip0 + static_cast<double>(row) * raster.cell, 0}));
      bool first = true;
      for (const double value : {place.along, place.down, at.x, at.y, at.z, comparison.a[cell],
                                 comparison.b[cell], comparison.difference[cell]}) {
        if (!first) table += ',';
        first = false;
        if (std::isfinite(value)) table += text::shortest(value);
      }
      table += '\n';
    }
  }
  refuse_to_replace_storage(file);
  write_whole_file(file, table);
}

}  // namespace footwall::tasks
