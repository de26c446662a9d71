#include "engine/tasks/project_facts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/mesh/surface_facts.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/set_statistic.h"
#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/formats/z_unit.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json lines_json(const survey::LineAxis& lines) {
  return {{"first", lines.first}, {"last", lines.last()}, {"step", lines.step}, {"count", lines.count}};
}

Json survey_json(const survey::Geometry& survey) {
  return {{"inlines", lines_json(survey.inlines)},
          {"crosslines", lines_json(survey.crosslines)},
          {"samples", survey.samples},
          {"z0", survey.z0},
          {"interval", survey.interval},
          {"vertical_unit", name_of(survey.vertical_unit)},
          {"domain", name_of(survey.domain)},
          {"z_positive", "down"},
          {"horizontal_unit", survey.horizontal_unit},
          {"crs", survey.crs.empty() ? Json() : Json(survey.crs)},
          {"map",
           {{"origin", {survey.map.origin_x, survey.map.origin_y}},
            {"per_inline", {survey.map.per_inline_x, survey.map.per_inline_y}},
            {"per_crossline", {survey.map.per_crossline_x, survey.map.per_crossline_y}}}}};
}

// "fault" or "continuous" for a discontinuity volume, null for others.
Json high_is(const project::VolumeRecord& volume) {
  if (volume.role != "discontinuity") return {};
  const Json provenance = Json::parse(volume.provenance, nullptr, false);
  return provenance.is_object() ? provenance.value("high_is", Json("fault")) : Json("fault");
}

Json volume_json(const project::VolumeRecord& volume) {
  const bool any = volume.null_count < volume.dims[0] * volume.dims[1] * volume.dims[2];
  const auto statistic = [&](double value) { return any ? number(value) : Json(); };
  return {{"name", volume.name},
          {"file", volume.file},
          {"dims", volume.dims},
          {"origin", volume.origin},
          {"min", statistic(volume.min)},
          {"max", statistic(volume.max)},
          {"mean", statistic(volume.mean)},
          {"stddev", statistic(volume.stddev)},
          {"null_count", volume.null_count},
          {"live_traces", volume.live_traces},
          {"role", volume.role},
          {"high_is", high_is(volume)},
          {"source", volume.source},
          {"null_value", volume.null_value ? Json(*volume.null_value) : Json()},
          {"bytes", volume.bytes},
          {"checksum", volume.checksum}};
}

// A surface's facts; its area where lengths and depths have a common unit.
Json facts_json(survey::Surface surface, const std::optional<survey::Geometry>& survey) {
  const bool metric = survey && survey->has_metric_depth();
  if (metric) {
    for (survey::WorldPoint& p : surface.vertices) {
      p = {survey->horizontal_metres(p.x), survey->horizontal_metres(p.y), survey->vertical_metres(p.z, 0)};
    }
  }
  const mesh::SurfaceFacts facts = mesh::surface_facts(surface);
  const double unit = metric ? survey->horizontal_metres(1) : 1;
  return {{"vertices", facts.vertices},     {"faces", facts.faces},
          {"components", facts.components}, {"boundary_loops", facts.boundary_loops},
          {"euler", facts.euler},           {"area", metric ? number(facts.area / (unit * unit)) : Json()}};
}

survey::Surface surface_of(const project::MeshRecord& mesh) {
  survey::Surface surface;
  for (const project::MeshVertex& vertex : mesh.vertices) surface.vertices.push_back(vertex.position);
  for (const project::MeshFace& face : mesh.faces) surface.triangles.push_back(face.vertices);
  return surface;
}

// Without a survey a surface knows its own units.
Json imported_json(const project::Project& project, const project::SurfaceRecord& record,
                   const std::optional<survey::Geometry>& survey) {
  survey::Surface surface = project.surface(record.id);
  const auto& [horizontal, vertical] = record.units;
  const bool lengths = vertical == "m" || vertical == "ft";
  if (survey || !lengths) return facts_json(std::move(surface), survey);
  const double factor = formats::z_unit_factor(vertical, horizontal);
  for (survey::WorldPoint& p : surface.vertices) p.z *= factor;
  Json facts = facts_json(surface, survey);
  facts["area"] = number(mesh::surface_facts(surface).area);
  return facts;
}

Json faults_json(const project::Project& project) {
  const std::optional<survey::Geometry> survey = project.survey();
  Json faults = Json::array();
  for (const project::FaultRecord& fault : project.faults()) {
    Json row = {{"name", fault.name}, {"pillars", project.pillars(fault.id).size()}};
    const auto imported = project.surface_of(fault.id);
    row["surface"] = imported ? Json(imported->kind) : Json();
    if (imported) {  // as it was imported; its mesh may be cut
      row.update(imported_json(project, *imported, survey));
    } else {
      const auto mesh = project.mesh(fault.id);
      row.update(facts_json(mesh ? surface_of(*mesh) : survey::Surface{}, survey));
    }
    row["stale"] = project.mesh_is_stale(fault.id);
    faults.push_back(std::move(row));
  }
  return faults;
}

void verify_all(const project::Project& project, const JobContext& job) {
  const project::IntegrityReport report = project.check();
  if (!report.ok()) {
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} is damaged: {}", project.path().string(), report.problems.front()),
                "restore it from a copy; what can still be read can be exported first");
  }
  const auto volumes = project.volumes();
  const auto missing = project.missing();
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    const bool gone = std::any_of(missing.begin(), missing.end(),
                                  [&](const auto& m) { return m.volume == volumes[n].name; });
    if (gone) continue;  // listed under missing[]
    const double share = 1.0 / static_cast<double>(volumes.size());
    open_volume(project, volumes[n])
        .verify(job.part(share * static_cast<double>(n), share * static_cast<double>(n + 1)));
  }
}

}  // namespace

Json project_facts(const project::Project& project, bool verify, const JobContext& job) {
  if (verify) verify_all(project, job);
  const std::optional<survey::Geometry> survey = project.survey();
  Json facts = {{"schema", project.schema_version()}, {"survey", survey ? survey_json(*survey) : Json()}};
  facts["volumes"] = Json::array();
  for (const project::VolumeRecord& volume : project.volumes())
    facts["volumes"].push_back(volume_json(volume));
  facts["faults"] = faults_json(project);
  facts["surfaces"] = Json::array();
  for (const project::SurfaceRecord& surface : project.surfaces()) {
    Json row = {{"name", surface.name}, {"kind", surface.kind}};
    row["fault"] = surface.fault == 0 ? Json() : Json(project.fault(surface.fault).name);
    row["horizontal_unit"] = surface.units.horizontal;
    row["vertical_unit"] = surface.units.vertical;
    row.update(imported_json(project, surface, survey));
    facts["surfaces"].push_back(std::move(row));
  }
  facts["truth"] = Json::array();
  for (const survey::Surface& truth : project.truth()) {
    Json row = {{"name", truth.name}};
    row.update(facts_json(truth, survey));
    facts["truth"].push_back(std::move(row));
  }
  facts["runs"] = Json::array();
  for (const project::RunRecord& run : project.runs()) {
    facts["runs"].push_back(
        {{"run", run.id},
         {"name", run.name},
         {"volume", run.volume.empty() ? Json() : Json(run.volume)},
         {"set_by_hand", statistic_set_by_hand(run).empty() ? Json() : Json(statistic_set_by_hand(run))},
         {"when", run.when}});
    const Json result = Json::parse(run.result, nullptr, false);
    facts["runs"].back()["faults"] =
        result.is_object() ? result.value("faults", Json::array()) : Json::array();
  }
  facts["statistics"] = Json::array();
  for (const project::StatisticRecord& statistic : known_statistics(project)) {
    facts["statistics"].push_back({{"name", statistic.name},
                                   {"unit", unit_of(statistic)},
                                   {"colours", statistic.colour_map},
                                   {"description", statistic.description}});
  }
  facts["missing"] = Json::array();
  for (const project::MissingFile& file : project.missing()) {
    facts["missing"].push_back(
        {{"volume", file.volume}, {"path", file.path.string()}, {"reason", file.reason}});
  }
  facts["assumed"] = survey ? Json(survey->assumed) : Json::array();
  facts["read_only"] = project.read_only();
  facts["verified"] = verify && facts["missing"].empty();
  return facts;
}

namespace {
Json imported_counts(const std::optional<project::SurfaceRecord>& surface) {
  if (!surface) return {};
  return {{"kind", surface->kind}, {"vertices", surface->vertices}, {"triangles", surface->triangles}};
}
}  // namespace

Json fault_list(const project::Project& project, const std::string& fault) {
  const std::optional<survey::Geometry> survey = project.survey();
  Json faults = Json::array();
  const auto chosen = fault.empty() ? project.faults() : chosen_faults(project, fault);
  for (const project::FaultRecord& record : chosen) {
    Json pillars = Json::array();
    for (const survey::Pillar& pillar : project.pillars(record.id)) {
      Json nodes = Json::array();
      for (const survey::PillarNode& node : pillar.nodes) {
        Json row = {
            {"node", node.id}, {"x", node.position.x}, {"y", node.position.y}, {"z", node.position.z}};
        if (survey) {
          const survey::IndexPoint at = survey->index_of(node.position);
          row["inline"] = survey->inlines.first + at.i * survey->inlines.step;
          row["crossline"] = survey->crosslines.first + at.j * survey->crosslines.step;
        }
        nodes.push_back(std::move(row));
      }
      Json row = {{"pillar", pillar.id}, {"kind", name_of(pillar.kind)}};
      if (pillar.kind == survey::PillarKind::kInterpolated)
        row["parents"] = {pillar.parent_a, pillar.parent_b};
      row["nodes"] = std::move(nodes);
      pillars.push_back(std::move(row));
    }
    faults.push_back({{"fault", record.id},
                      {"name", record.name},
                      {"colour", record.colour},
                      {"interpreter", record.interpreter},
                      {"status", record.status},
                      {"note", record.note},
                      {"modified", record.modified},
                      {"locked", record.locked},
                      {"surface", imported_counts(project.surface_of(record.id))},
                      {"pillars", std::move(pillars)}});
  }
  return {{"faults", std::move(faults)}};
}

}  // namespace footwall::tasks
