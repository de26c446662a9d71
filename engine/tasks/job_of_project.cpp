#include "engine/tasks/job_of_project.h"

#include <fmt/format.h>

#include "engine/extract/computations.h"
#include "engine/extract/registry.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

// A fresh mesh of the fault; nothing where it cannot be made a surface, which is noted.
std::optional<project::MeshRecord> fresh_mesh(project::Project& project, const project::FaultRecord& fault,
                                              const ExtractOptions& options, FreshMeshes meshes,
                                              JobOfProject& made, const JobContext& context) {
  if (!project.mesh_is_stale(fault.id)) return project.mesh(fault.id);
  try {
    log::info(fmt::format("triangulating {} first: its pillars changed since its mesh was made", fault.name));
    project::MeshRecord mesh = mesh_of_fault(project, fault, {}, context);
    if (meshes == FreshMeshes::kStored) project.store_mesh(fault.id, mesh);
    made.triangulated.push_back(fault.name);
    return mesh;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalid || !options.fault.empty()) throw;
    log::warn(fmt::format("{} is left out: {}", fault.name, error.message()));
    made.skipped.push_back(fault.name + ": " + error.message());
    return std::nullopt;
  }
}

// The mesh's faces on the lattice of the survey; `origin` voxels are taken off for a volume that starts
// there.
session::JobFault job_fault(const project::FaultRecord& fault, const project::MeshRecord& mesh,
                            const survey::Lattice& lattice, const survey::Index& origin) {
  std::vector<survey::LatticePoint> points;
  points.reserve(mesh.vertices.size());
  for (const project::MeshVertex& vertex : mesh.vertices) {
    try {
      const survey::IndexPoint at = lattice.geometry().index_of(vertex.position);
      points.push_back(
          lattice.from_index({at.i - static_cast<double>(origin[0]), at.j - static_cast<double>(origin[1]),
                              at.k - static_cast<double>(origin[2])}));
    } catch (const Error& error) {
      throw Error(
          error.code(),
          fmt::format("fault {}, vertex {}.{}: {}", fault.name, vertex.owner, vertex.n, error.message()),
          error.hint());
    }
  }
  session::JobFault out{fault.id, fault.name, {}, mesh.revision};
  out.faces.reserve(mesh.faces.size());
  for (const project::MeshFace& face : mesh.faces) {
    const auto at = [&](int corner) {
      return points[static_cast<std::size_t>(face.vertices[static_cast<std::size_t>(corner)])];
    };
    out.faces.push_back({fault.id, face.panel, face.n, {at(0), at(1), at(2)}});
  }
  return out;
}

}  // namespace

std::vector<std::string> default_statistics() {
  std::vector<std::string> names;
  for (const extract::Computation& row : extract::computations()) {
    if (row.by_default || row.name == "contrast") names.emplace_back(row.name);
  }
  return names;
}

JobOfProject job_of_project(project::Project& project, const ExtractOptions& options, FreshMeshes meshes,
                            const JobContext& context) {
  JobOfProject made;
  session::Job& job = made.job;
  job.options = options.engine;
  if (job.options.compute.empty()) job.options.compute = default_statistics();
  job.options.threads = options.launch.threads > 0 ? options.launch.threads : session::default_threads();
  extract::validate(job.options);
  if (!options.name.empty()) project::check_name("run", options.name);
  const survey::Geometry survey = required_survey(project, "EXTRACT-ALL");
  const project::VolumeRecord volume = present_volume(project, options.volume);
  job.volume = std::filesystem::absolute(project.volume_path(volume));
  job.volume_checksum = volume.checksum;
  job.volume_name = volume.name;
  job.volume_origin = volume.origin;
  job.geometry = open_volume(project, volume).info().geometry;
  job.velocity = options.velocity;
  job.run = options.name;

  const survey::Lattice lattice(survey);
  for (const project::FaultRecord& fault : chosen_faults(project, options.fault)) {
    const auto mesh = fresh_mesh(project, fault, options, meshes, made, context);
    if (mesh) job.faults.push_back(job_fault(fault, *mesh, lattice, volume.origin));
  }
  if (job.faults.empty()) {
    throw Error(ErrorCode::kInvalid, "no fault has a surface to extract",
                "pick at least two pillars on a fault (footwall edit, footwall import sticks)");
  }
  return made;
}

}  // namespace footwall::tasks
