#include "engine/tasks/face_tables.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "engine/tasks/imported_surface.h"
#include "engine/tasks/set_statistic.h"
#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/formats/z_unit.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

struct LatticeHash {
  std::size_t operator()(const survey::LatticePoint& p) const {
    std::uint64_t h = static_cast<std::uint32_t>(p.i) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ static_cast<std::uint32_t>(p.j)) * 0xC2B2AE3D27D4EB4FULL;
    return (h ^ static_cast<std::uint32_t>(p.k)) * 0x165667B19E3779F9ULL;
  }
};

// The mesh as picked, or as the file of an imported surface has it.
void fill_world(formats::MeshTable& table, const project::Project& project, const project::FaultRecord& fault,
                const project::MeshRecord& mesh) {
  const auto imported = is_imported(mesh) ? project.surface_of(fault.id) : std::nullopt;
  if (imported && mesh.faces.size() == static_cast<std::size_t>(imported->triangles)) {
    survey::Surface surface = surface_in_survey(project, *imported);
    table.vertices = std::move(surface.vertices);
    table.triangles = std::move(surface.triangles);
    return;
  }
  for (const project::MeshVertex& vertex : mesh.vertices) table.vertices.push_back(vertex.position);
  for (const project::MeshFace& face : mesh.faces) table.triangles.push_back(face.vertices);
}

// The run's own triangles, welded by lattice position; the picked positions while the mesh is that of the
// run.
void fill_shape(formats::MeshTable& table, const project::Project& project, const project::FaultRecord& fault,
                const project::FaultRun& run, const survey::Lattice& lattice, Coordinates coordinates) {
  const auto mesh = project.mesh(fault.id);
  const bool same_mesh = mesh && mesh->revision == run.revision && mesh->faces.size() == run.lattice.size();
  if (same_mesh && coordinates == Coordinates::kWorld) {
    fill_world(table, project, fault, *mesh);
  } else {
    std::unordered_map<survey::LatticePoint, std::int32_t, LatticeHash> known;
    for (const survey::LatticeTriangle& triangle : run.lattice) {
      std::array<std::int32_t, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [at, added] = known.emplace(triangle[c], static_cast<std::int32_t>(table.vertices.size()));
        if (added) {
          const survey::IndexPoint p = survey::Lattice::index_of(triangle[c]);
          table.vertices.push_back(coordinates == Coordinates::kIndex ? survey::WorldPoint{p.i, p.j, p.k}
                                                                      : lattice.world_of(triangle[c]));
        }
        corners[c] = at->second;
      }
      table.triangles.push_back(corners);
    }
  }
  for (std::size_t f = 0; f < run.panels.size(); ++f)
    table.face_ids.push_back(face_id(run.panels[f], run.numbers[f]));
}

formats::MeshTable of_run(const project::Project& project, const project::FaultRecord& fault,
                          const project::FaultRun& run, const survey::Lattice& lattice,
                          Coordinates coordinates) {
  formats::MeshTable table;
  table.fault = fault.name;
  fill_shape(table, project, fault, run, lattice, coordinates);
  // Known statistics come in their usual order, others behind them.
  std::map<std::string, std::vector<double>> left = run.statistics;
  for (const project::StatisticRecord& known : stored_statistics()) {
    const auto found = left.find(known.name);
    if (found == left.end()) continue;
    table.statistics.push_back({found->first, std::move(found->second)});
    left.erase(found);
  }
  for (auto& [name, values] : left) table.statistics.push_back({name, std::move(values)});
  return table;
}

// lattice: none for world coordinates.
formats::MeshTable of_mesh(const project::Project& project, const project::FaultRecord& fault,
                           const project::MeshRecord& mesh, const std::optional<survey::Lattice>& lattice) {
  formats::MeshTable table;
  table.fault = fault.name;
  if (!lattice) {
    fill_world(table, project, fault, mesh);
  } else {
    for (const project::MeshVertex& vertex : mesh.vertices) {
      const survey::IndexPoint p = survey::Lattice::index_of(lattice->from_world(vertex.position));
      table.vertices.push_back({p.i, p.j, p.k});
    }
    for (const project::MeshFace& face : mesh.faces) table.triangles.push_back(face.vertices);
  }
  for (const project::MeshFace& face : mesh.faces) table.face_ids.push_back(face_id(face.panel, face.n));
  return table;
}

// Without a survey every surface keeps its file's units; one file can hold one of them.
void note_units(FaceTables& out, const project::Project& project, const project::FaultRecord& fault) {
  const auto surface = project.surface_of(fault.id);
  if (!surface) return;
  if (out.tables.size() > 1 && surface->units != out.units) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("fault {} is in {} and {}, others are in {} and {}, and there is no survey",
                            fault.name, surface->units.horizontal, surface->units.vertical,
                            out.units.horizontal, out.units.vertical),
                "choose one with --fault");
  }
  out.units = surface->units;
}

void turn_z_into(const std::string& unit, FaceTables& faces) {
  const double factor = formats::z_unit_factor(faces.units.vertical, unit);
  faces.units.vertical = unit;
  if (factor == 1) return;
  for (formats::MeshTable& table : faces.tables) {
    for (survey::WorldPoint& p : table.vertices) p.z *= factor;
  }
}

FaceTables tables_in(const std::optional<survey::Geometry>& survey) {
  FaceTables out;
  if (!survey) return out;
  out.crs = survey->crs;
  out.units = {survey->horizontal_unit, std::string(name_of(survey->vertical_unit))};
  return out;
}

}  // namespace

std::string face_id(std::int64_t panel, std::int32_t n) {
  constexpr int kPillarBits = 31;
  if (panel < 0) return fmt::format("cell {:x}.{}", static_cast<std::uint64_t>(panel), n);
  if (panel >> kPillarBits == 0) return fmt::format("{}.{}", panel, n);
  return fmt::format("{}-{}.{}", panel >> kPillarBits, panel & ((std::int64_t{1} << kPillarBits) - 1), n);
}

std::optional<project::RunRecord> chosen_run(const project::Project& project, std::optional<std::int64_t> run,
                                             const std::string& statistic) {
  if (run) return project.run(run);
  const std::vector<project::RunRecord> runs = project.runs();
  const auto last = [&](const auto& wanted) -> std::optional<project::RunRecord> {
    const auto found = std::find_if(runs.rbegin(), runs.rend(), wanted);
    return found == runs.rend() ? std::nullopt : std::optional(*found);
  };
  const auto by_hand = [](const project::RunRecord& each) { return statistic_set_by_hand(each); };
  if (!statistic.empty()) {
    auto found = last([&](const project::RunRecord& each) { return by_hand(each) == statistic; });
    if (found) return found;
  }
  auto computed = last([&](const project::RunRecord& each) { return by_hand(each).empty(); });
  if (computed || runs.empty() || !statistic.empty()) return computed;
  return runs.back();
}

FaceTables face_tables(const project::Project& project, const std::string& fault,
                       std::optional<std::int64_t> run, Coordinates coordinates, const std::string& z_unit) {
  std::optional<project::RunRecord> chosen = chosen_run(project, run);
  if (!chosen) return present_faces(project, fault, coordinates, z_unit);
  const survey::Geometry survey = required_survey(project, "index space");
  FaceTables out = tables_in(survey);
  out.run = std::move(chosen);
  const std::vector<std::int64_t> in_run = project.run_faults(out.run->id);
  for (const project::FaultRecord& record : chosen_faults(project, fault)) {
    if (std::find(in_run.begin(), in_run.end(), record.id) == in_run.end()) continue;
    const project::FaultRun stored = project.fault_statistics(out.run->id, record.id);
    if (stored.revision != record.revision) out.stale.push_back(record.name);
    out.tables.push_back(of_run(project, record, stored, survey::Lattice(survey), coordinates));
  }
  if (coordinates == Coordinates::kWorld && !z_unit.empty()) turn_z_into(z_unit, out);
  return out;
}

FaceTables present_faces(const project::Project& project, const std::string& fault, Coordinates coordinates,
                         const std::string& z_unit) {
  std::optional<survey::Geometry> survey = project.survey();
  if (coordinates == Coordinates::kIndex) survey = required_survey(project, "index space");
  FaceTables out = tables_in(survey);
  for (const project::FaultRecord& record : chosen_faults(project, fault)) {
    const auto mesh = project.mesh(record.id);
    if (!mesh) continue;
    if (mesh->revision != record.revision) out.stale.push_back(record.name);
    out.tables.push_back(
        of_mesh(project, record, *mesh,
                coordinates == Coordinates::kIndex ? std::optional<survey::Lattice>(*survey) : std::nullopt));
    if (!survey) note_units(out, project, record);
  }
  if (coordinates == Coordinates::kWorld && !z_unit.empty()) turn_z_into(z_unit, out);
  return out;
}

std::vector<double> counts_of(const formats::MeshTable& table) {
  for (const formats::FaceStatistic& known : table.statistics) {
    if (known.name == "count") return known.values;
  }
  return {};
}

const std::vector<double>& values_of(const formats::MeshTable& table, const std::string& statistic) {
  std::string names;
  for (const formats::FaceStatistic& known : table.statistics) {
    if (known.name == statistic) return known.values;
    names += (names.empty() ? "" : ", ") + known.name;
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no statistic '{}'", statistic),
              names.empty() ? "footwall extract computes them" : "there are: " + names);
}

std::vector<RankedFace> ranked_faces(const FaceTables& faces, const std::string& statistic, bool lowest_first,
                                     std::size_t most, double least_count) {
  std::vector<RankedFace> ranked;
  for (std::size_t t = 0; t < faces.tables.size(); ++t) {
    const std::vector<double>& values = values_of(faces.tables[t], statistic);
    const std::vector<double> counts = counts_of(faces.tables[t]);
    for (std::size_t f = 0; f < values.size(); ++f) {
      const bool enough = counts.empty() || counts[f] >= least_count;
      if (enough && !std::isnan(values[f])) ranked.push_back({t, f, values[f]});
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [&](const RankedFace& a, const RankedFace& b) {
    return lowest_first ? a.value < b.value : a.value > b.value;
  });
  if (ranked.size() > most) ranked.resize(most);
  return ranked;
}

}  // namespace footwall::tasks
