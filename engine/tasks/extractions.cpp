#include "engine/tasks/extractions.h"

#include <fmt/format.h>

#include "engine/tasks/job_of_project.h"
#include "engine/tasks/workload/grow.h"
#include "engine/tasks/workload/script.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

std::vector<extract::Face> faces_of(const mesh::MeshSet& meshes) {
  std::vector<extract::Face> faces;
  for (const mesh::FaceKey& key : meshes.faces()) {
    faces.push_back({key.mesh, 0, static_cast<std::int32_t>(key.face), meshes.triangle(key)});
  }
  return faces;
}

}  // namespace

Extractions extractions_of_script(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = std::size_t{4} << 30;
  const Workload workload = parse_script(read_whole_file(path, kLargest));
  Extractions made{workload.size, {}};
  mesh::MeshSet meshes;
  for (const WorkloadRepeat& repeat : workload.repeats) {
    for (const WorkloadStep& step : repeat.steps) {
      for (const mesh::Operation& operation : step.operations) meshes.apply(operation);
      if (step.extract) made.faces.push_back(faces_of(meshes));
    }
    if (!made.faces.empty()) return made;
  }
  throw Error(ErrorCode::kInvalid, fmt::format("{} extracts nothing", path.string()),
              "give a script with an EXTRACT-ALL");
}

Extractions extractions_of(const RandomFaces& shape, const JobContext& job) {
  constexpr std::int64_t kMeshes = 16;
  if (shape.faces < 1 || shape.cycles < 1 || !(shape.area > 0)) {
    throw Error(ErrorCode::kUsage, "there is nothing to extract", "--faces, --area and --cycles are above 0");
  }
  Extractions made{shape.size, {}};
  Grower grower(shape.size, shape.area, shape.distance, shape.seed);
  mesh::MeshSet meshes;
  std::vector<mesh::Operation> operations;
  for (std::int64_t n = 0; n < kMeshes; ++n) {
    job.check();
    grower.grow(shape.faces / kMeshes + (n < shape.faces % kMeshes ? 1 : 0), meshes, operations);
    operations.clear();
  }
  for (std::int64_t cycle = 0; cycle < shape.cycles; ++cycle) {
    job.check();
    for (mesh::MeshId id = 0; cycle > 0 && id < meshes.mesh_limit(); ++id) {
      for (mesh::VertexId v = 0; v < meshes.mesh(id).vertex_limit(); ++v)
        meshes.apply(mesh::MoveVertex{id, v, grower.moved(meshes.mesh(id).position(v))});
    }
    made.faces.push_back(faces_of(meshes));
  }
  return made;
}

Extractions extractions_of_project(project::Project& project, const JobContext& job) {
  const JobOfProject made = job_of_project(project, {}, FreshMeshes::kThrownAway, job);
  Extractions extractions{made.job.geometry.dims(), {{}}};
  for (const session::JobFault& fault : made.job.faults) {
    extractions.faces.front().insert(extractions.faces.front().end(), fault.faces.begin(), fault.faces.end());
  }
  return extractions;
}

}  // namespace footwall::tasks
