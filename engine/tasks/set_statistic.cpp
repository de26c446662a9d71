#include "engine/tasks/set_statistic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/tasks/face_tables.h"
#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/formats/face_values_csv.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::json;
using formats::face_values_csv::FaceValue;

constexpr const char* kStatisticKey = "set_statistic";  // in RunRecord::parameters
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLongestUnit = 40;
constexpr std::size_t kNamedAtMost = 5;

void check_words(const SetStatistic& what) {
  project::check_name("statistic", what.name);
  if (!what.run.empty()) project::check_name("run", what.run);
  project::check_name("unit", what.unit);
  if (what.unit.size() > kLongestUnit)
    throw Error(ErrorCode::kInvalid, fmt::format("a unit has at most {} bytes", kLongestUnit));
  const auto own = stored_statistics();
  bool taken =
      std::any_of(own.begin(), own.end(), [&](const auto& known) { return known.name == what.name; });
  for (const char* column : {"fault", "face", "value", "x0", "y0", "z0", "x1", "y1", "z1", "x2", "y2", "z2",
                             "xy_unit", "z_unit", "z_positive", "crs"}) {
    taken = taken || what.name == column;
  }
  if (taken) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("'{}' is the name of one of the program's own columns", what.name),
                "choose another name");
  }
}

// Where a face stands: which of the runs, and which of its faces.
struct Place {
  std::size_t fault = 0;
  std::size_t face = 0;
};

std::vector<project::FaultRun> empty_runs(const project::Project& project, const std::string& name) {
  const survey::Lattice lattice(required_survey(project, "a statistic"));
  std::vector<project::FaultRun> runs;
  for (const project::FaultRecord& fault : project.faults()) {
    const auto mesh = project.mesh(fault.id);
    if (!mesh) continue;
    project::FaultRun& run = runs.emplace_back();
    run.fault = fault.id;
    run.fault_name = fault.name;
    run.revision = mesh->revision;
    for (const project::MeshFace& face : mesh->faces) {
      run.panels.push_back(face.panel);
      run.numbers.push_back(face.n);
      survey::LatticeTriangle& triangle = run.lattice.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const auto vertex = static_cast<std::size_t>(face.vertices[c]);
        triangle[c] = lattice.from_world(mesh->vertices[vertex].position);
      }
    }
    run.statistics[name].assign(mesh->faces.size(), kUndefined);
  }
  if (runs.empty())
    throw Error(ErrorCode::kInvalid, "no fault has a mesh yet", "footwall triangulate makes them");
  return runs;
}

std::unordered_multimap<std::string, Place> places_of(const std::vector<project::FaultRun>& runs) {
  std::unordered_multimap<std::string, Place> places;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t f = 0; f < runs[r].panels.size(); ++f)
      places.emplace(face_id(runs[r].panels[f], runs[r].numbers[f]), Place{r, f});
  }
  return places;
}

// The place of a row's face, or nothing.
std::optional<Place> place_of(const FaceValue& row, const std::vector<project::FaultRun>& runs,
                              const std::unordered_multimap<std::string, Place>& places) {
  const auto [first, last] = places.equal_range(row.face);
  std::optional<Place> found;
  for (auto at = first; at != last; ++at) {
    if (!row.fault.empty() && runs[at->second.fault].fault_name != row.fault) continue;
    if (found) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("line {}: faults {} and {} both have a face {}", row.line,
                              runs[found->fault].fault_name, runs[at->second.fault].fault_name, row.face),
                  "add a column 'fault'");
    }
    found = at->second;
  }
  return found;
}

std::string name_of(const FaceValue& row) {
  return fmt::format("{}{} (line {})", row.fault.empty() ? "" : row.fault + " ", row.face, row.line);
}

void refuse_absent(const std::vector<std::string>& absent, std::size_t count) {
  if (count == 0) return;
  throw Error(ErrorCode::kInvalid,
              fmt::format("{} of the faces are not there: {}{}", count, fmt::join(absent, ", "),
                          count > absent.size() ? " ..." : ""),
              "footwall faces lists the faces of the present meshes with --present --csv");
}

// Returns how many faces got a number.
std::int64_t fill(std::vector<project::FaultRun>& runs, const std::string& name,
                  const std::vector<FaceValue>& rows) {
  const auto places = places_of(runs);
  std::vector<std::vector<bool>> seen;
  for (const project::FaultRun& run : runs) seen.emplace_back(run.panels.size());
  std::vector<std::string> absent;
  std::size_t absent_count = 0;
  std::int64_t defined = 0;
  for (const FaceValue& row : rows) {
    const auto place = place_of(row, runs, places);
    if (!place) {
      ++absent_count;
      if (absent.size() < kNamedAtMost) absent.push_back(name_of(row));
      continue;
    }
    if (seen[place->fault][place->face]) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("line {}: face {} stands in the table twice", row.line, row.face));
    }
    seen[place->fault][place->face] = true;
    runs[place->fault].statistics[name][place->face] = row.value;
    if (!std::isnan(row.value)) ++defined;
  }
  refuse_absent(absent, absent_count);
  return defined;
}

// A unit is one of the statistic: all its runs have it.
void check_unit(const project::Project& project, const SetStatistic& what, const std::string& run_name) {
  const auto known = project.statistics();
  const auto row = std::find_if(known.begin(), known.end(),
                                [&](const auto& statistic) { return statistic.name == what.name; });
  if (row == known.end() || row->unit_rule == what.unit) return;
  for (const project::RunRecord& run : project.runs()) {
    if (statistic_set_by_hand(run) != what.name || run.name == run_name) continue;
    throw Error(ErrorCode::kInvalid,
                fmt::format("run {} has {} in {}, not in {}", run.id, what.name, row->unit_rule, what.unit),
                "choose another name for the statistic");
  }
}

}  // namespace

std::string statistic_set_by_hand(const project::RunRecord& run) {
  if (!run.volume.empty()) return {};
  const Json parameters = Json::parse(run.parameters, nullptr, false);
  if (!parameters.is_object() || !parameters.contains(kStatisticKey)) return {};
  const Json& name = parameters[kStatisticKey];
  return name.is_string() ? name.get<std::string>() : std::string();
}

StatisticSet set_statistic(project::Project& project, const SetStatistic& what, std::istream& values) {
  check_words(what);
  StatisticSet done;
  done.run_name = what.run.empty() ? what.name : what.run;
  check_unit(project, what, done.run_name);
  std::vector<project::FaultRun> runs = empty_runs(project, what.name);
  done.faces = fill(runs, what.name, formats::face_values_csv::read(values, what.name));
  for (const project::FaultRun& run : runs) done.undefined += static_cast<std::int64_t>(run.panels.size());
  done.undefined -= done.faces;

  std::vector<std::int64_t> former;
  for (const project::RunRecord& run : project.runs()) {
    if (run.name == done.run_name && statistic_set_by_hand(run) == what.name) former.push_back(run.id);
  }
  project::StatisticRecord statistic;
  statistic.name = what.name;
  statistic.unit_rule = what.unit;
  statistic.description = "set by hand";
  project.register_statistics(std::span(&statistic, 1));
  project::RunRecord record;
  record.name = done.run_name;
  record.parameters = Json{{kStatisticKey, what.name}}.dump();
  done.run = project.add_run(record, runs);
  for (const std::int64_t run : former) project.delete_run(run);
  done.replaced = !former.empty();
  return done;
}

}  // namespace footwall::tasks
