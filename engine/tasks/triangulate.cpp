#include "engine/tasks/triangulate.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/pillars/interpolate.h"
#include "engine/pillars/triangulate.h"
#include "engine/pillars/world.h"
#include "engine/tasks/imported_surface.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr const char* kAlgorithm = "panels 1";

project::Bytes packed(const pillars::Chart& chart) {
  const std::string text = chart.to_text();
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::optional<pillars::Chart> unpacked(const project::Bytes& bytes) {
  if (bytes.empty()) return std::nullopt;
  return pillars::Chart::from_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// The chart that the fault was first triangulated in, if it was.
std::optional<pillars::Chart> stored_chart(const project::Project& project,
                                           const project::FaultRecord& fault) {
  if (!fault.chart.empty()) return unpacked(fault.chart);
  const auto mesh = project.mesh(fault.id);
  return mesh ? unpacked(mesh->chart) : std::nullopt;
}

Error about(const project::FaultRecord& fault, const Error& error) {
  return {error.code(), fmt::format("fault {}: {}", fault.name, error.message()), error.hint()};
}

project::MeshRecord mesh_record(const survey::Geometry& survey, const project::FaultRecord& fault,
                                std::span<const survey::Pillar> stored, const pillars::FaultMesh& mesh,
                                const TriangulateOptions& options) {
  const std::vector<survey::WorldPoint> places = pillars::world_vertices(survey, stored, mesh);
  project::MeshRecord record;
  record.revision = fault.revision;
  record.algorithm = kAlgorithm;
  record.parameters =
      nlohmann::json{{"detail", options.detail}, {"max_edge", options.max_edge}, {"tie", options.tie}}.dump();
  record.chart = packed(mesh.chart);
  record.vertices.reserve(mesh.vertices.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const pillars::MeshVertex& vertex = mesh.vertices[n];
    project::MeshVertex out;
    const bool on_pillar = vertex.kind == pillars::MeshVertex::Kind::kPillar;
    out.kind = on_pillar ? project::MeshVertex::Owner::kPillar : project::MeshVertex::Owner::kPanel;
    out.owner = vertex.owner;
    out.n = vertex.n;
    out.position = places[n];
    record.vertices.push_back(out);
  }
  record.faces.reserve(mesh.faces.size());
  for (const pillars::MeshFace& face : mesh.faces)
    record.faces.push_back({face.panel, face.n, face.vertices});
  return record;
}

// A fault that is an imported surface has its triangles already.
project::MeshRecord adopted_mesh(const project::Project& project, const project::FaultRecord& fault,
                                 const project::SurfaceRecord& record, std::vector<std::string>* notes) {
  survey::Surface surface = surface_in_survey(project, record);
  surface.name = fault.name;
  std::vector<std::string> cuts;
  project::MeshRecord mesh = imported_mesh(surface, fault.revision, cuts);
  if (notes != nullptr) *notes = std::move(cuts);
  return mesh;
}

}  // namespace

survey::Geometry required_survey(const project::Project& project, std::string_view what) {
  if (auto survey = project.survey()) return *survey;
  throw Error(ErrorCode::kInvalid, fmt::format("{} needs a survey, and the project has none", what),
              fmt::format("footwall import volume {} FILE gives it one", project.path().string()));
}

std::vector<project::FaultRecord> chosen_faults(const project::Project& project, const std::string& name) {
  if (!name.empty()) return {project.fault(name)};
  std::vector<project::FaultRecord> faults = project.faults();
  if (faults.empty()) {
    throw Error(ErrorCode::kNotFound, "the project has no faults",
                "footwall import sticks or footwall edit add them");
  }
  return faults;
}

project::MeshRecord mesh_of_fault(const project::Project& project, const project::FaultRecord& fault,
                                  const TriangulateOptions& options, const JobContext& job,
                                  std::vector<std::string>* notes) {
  if (const auto surface = project.surface_of(fault.id)) return adopted_mesh(project, fault, *surface, notes);
  const survey::Geometry survey = required_survey(project, "triangulation");
  const std::vector<survey::Pillar> stored = project.pillars(fault.id);
  project::Bytes chart = fault.chart;
  if (chart.empty()) {
    if (const auto former = project.mesh(fault.id)) chart = former->chart;
  }
  try {
    return mesh_of_pillars(survey, fault, stored, chart, options, job, notes);
  } catch (const Error& error) {
    throw about(fault, error);
  }
}

project::MeshRecord mesh_of_pillars(const survey::Geometry& survey, const project::FaultRecord& fault,
                                    std::span<const survey::Pillar> stored, const project::Bytes& chart,
                                    const TriangulateOptions& options, const JobContext& job,
                                    std::vector<std::string>* notes) {
  const pillars::FaultMesh mesh =
      pillars::triangulate(pillars::inputs_of(survey, stored),
                           {options.detail, options.max_edge, options.tie, pillars::place_text_of(survey)},
                           options.rechart ? std::nullopt : unpacked(chart), job);
  if (notes != nullptr) *notes = mesh.notes;
  return mesh_record(survey, fault, stored, mesh, options);
}

Triangulated triangulate_fault(project::Project& project, const project::FaultRecord& fault,
                               const TriangulateOptions& options, const JobContext& job) {
  std::vector<std::string> notes;
  const project::MeshRecord mesh = mesh_of_fault(project, fault, options, job, &notes);
  project.store_mesh(fault.id, mesh);
  return {fault.name, static_cast<std::int64_t>(mesh.vertices.size()),
          static_cast<std::int64_t>(mesh.faces.size()), notes};
}

std::int64_t interpolate_fault(project::Project& project, const project::FaultRecord& fault,
                               const InterpolateOptions& options, const JobContext& job) {
  if (project.surface_of(fault.id)) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("fault {} is an imported surface: there are no pillars to interpolate between",
                            fault.name));
  }
  const survey::Geometry survey = required_survey(project, "interpolation");
  std::vector<survey::Pillar> picked = project.pillars(fault.id);
  std::vector<std::int64_t> former;
  std::erase_if(picked, [&](const survey::Pillar& pillar) {
    if (pillar.kind != survey::PillarKind::kInterpolated) return false;
    former.push_back(pillar.id);
    return true;
  });
  try {
    pillars::InterpolateOptions how;
    how.every_lines = options.every;
    how.tolerance = options.tolerance;
    how.place_text = pillars::place_text_of(survey);
    const pillars::Interpolation made =
        pillars::interpolate(pillars::inputs_of(survey, picked), how, stored_chart(project, fault), job);
    project.edit("Interpolate pillars of " + fault.name, [&](project::Interpretation& picks) {
      for (const std::int64_t pillar : former) picks.delete_pillar(pillar);
      for (const pillars::InterpolatedPillar& one : made.pillars) {
        survey::Pillar pillar;
        pillar.kind = survey::PillarKind::kInterpolated;
        pillar.parent_a = one.parents.a;
        pillar.parent_b = one.parents.b;
        pillar.parameter = one.parents.parameter;
        for (const survey::IndexPoint& node : one.nodes) pillar.nodes.push_back({0, survey.world_of(node)});
        picks.add_pillar(fault.id, pillar);
      }
    });
    return static_cast<std::int64_t>(made.pillars.size());
  } catch (const Error& error) {
    throw about(fault, error);
  }
}

std::int64_t remove_interpolated(project::Project& project, const project::FaultRecord& fault) {
  std::int64_t removed = 0;
  project.edit("Remove interpolated pillars of " + fault.name, [&](project::Interpretation& picks) {
    for (const survey::Pillar& pillar : picks.pillars(fault.id)) {
      if (pillar.kind != survey::PillarKind::kInterpolated) continue;
      picks.delete_pillar(pillar.id);
      ++removed;
    }
  });
  return removed;
}

void follow_parents(project::Project& project) {
  const std::optional<survey::Geometry> survey = project.survey();
  if (!survey) return;  // without index space the straight line between the parents stays
  project.set_regenerator([survey = *survey](const project::FaultRecord& fault,
                                             std::span<const survey::Pillar> all,
                                             std::span<const survey::Pillar> children) {
    std::vector<survey::Pillar> picked;
    for (const survey::Pillar& pillar : all) {
      if (pillar.kind != survey::PillarKind::kInterpolated) picked.push_back(pillar);
    }
    std::vector<pillars::Parents> parents;
    for (const survey::Pillar& child : children)
      parents.push_back({child.parent_a, child.parent_b, child.parameter});
    const pillars::Interpolation made =
        pillars::regenerate(pillars::inputs_of(survey, picked), parents, {}, unpacked(fault.chart), {});
    std::vector<std::vector<survey::WorldPoint>> lines;
    for (const pillars::InterpolatedPillar& one : made.pillars) {
      std::vector<survey::WorldPoint>& line = lines.emplace_back();
      for (const survey::IndexPoint& node : one.nodes) line.push_back(survey.world_of(node));
    }
    return lines;
  });
}

}  // namespace footwall::tasks
