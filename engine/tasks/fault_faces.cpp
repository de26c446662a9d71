#include "engine/tasks/fault_faces.h"

#include <fmt/format.h>

#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::tasks {

std::optional<project::MeshRecord> fresh_mesh(project::Project& project, const project::FaultRecord& fault,
                                              bool required, FreshMeshes meshes, MeshNotes& notes,
                                              const JobContext& job) {
  if (!project.mesh_is_stale(fault.id)) return project.mesh(fault.id);
  try {
    log::info(fmt::format("triangulating {} first: its pillars changed since its mesh was made", fault.name));
    project::MeshRecord mesh = mesh_of_fault(project, fault, {}, job);
    if (meshes == FreshMeshes::kStored) project.store_mesh(fault.id, mesh);
    notes.triangulated.push_back(fault.name);
    return mesh;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalid || required) throw;
    log::warn(fmt::format("{} is left out: {}", fault.name, error.message()));
    notes.skipped.push_back(fault.name + ": " + error.message());
    return std::nullopt;
  }
}

std::vector<extract::Face> fault_faces(const project::FaultRecord& fault, const project::MeshRecord& mesh,
                                       const survey::Lattice& lattice, const survey::Index& origin) {
  std::vector<survey::LatticePoint> points;
  points.reserve(mesh.vertices.size());
  for (const project::MeshVertex& vertex : mesh.vertices) {
    try {
      const survey::LatticePoint in_survey = lattice.from_world(vertex.position);
      points.push_back(survey::moved(in_survey, {-origin[0], -origin[1], -origin[2]}));
    } catch (const Error& error) {
      throw Error(
          error.code(),
          fmt::format("fault {}, vertex {}.{}: {}", fault.name, vertex.owner, vertex.n, error.message()),
          error.hint());
    }
  }
  std::vector<extract::Face> faces;
  faces.reserve(mesh.faces.size());
  for (const project::MeshFace& face : mesh.faces) {
    const auto at = [&](int corner) {
      return points[static_cast<std::size_t>(face.vertices[static_cast<std::size_t>(corner)])];
    };
    faces.push_back({fault.id, face.panel, face.n, {at(0), at(1), at(2)}});
  }
  return faces;
}

}  // namespace footwall::tasks
