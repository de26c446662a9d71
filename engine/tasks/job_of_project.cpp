#include "engine/tasks/job_of_project.h"

#include "engine/extract/registry.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {

std::vector<project::FaultRecord> faults_of(const project::Project& project, const ExtractOptions& options) {
  if (options.faults.empty()) return chosen_faults(project, options.fault);
  std::vector<project::FaultRecord> faults;
  for (const std::int64_t fault : options.faults) faults.push_back(project.fault(fault));
  return faults;
}

JobOfProject job_of_project(project::Project& project, const ExtractOptions& options, FreshMeshes meshes,
                            const JobContext& context) {
  JobOfProject made;
  session::Job& job = made.job;
  job.options = options.engine;
  if (job.options.compute.empty()) job.options.compute = extract::usual_computations();
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
  MeshNotes notes;
  const std::vector<project::FaultRecord> faults = faults_of(project, options);
  const bool names_one = options.faults.empty() ? !options.fault.empty() : faults.size() == 1;
  for (const project::FaultRecord& fault : faults) {
    const auto mesh = fresh_mesh(project, fault, names_one, meshes, notes, context);
    if (!mesh) continue;
    job.faults.push_back(
        {fault.id, fault.name, fault_faces(fault, *mesh, lattice, volume.origin), mesh->revision});
  }
  made.triangulated = std::move(notes.triangulated);
  made.skipped = std::move(notes.skipped);
  if (job.faults.empty()) {
    throw Error(ErrorCode::kInvalid, "no fault has a surface to extract",
                "pick at least two pillars on a fault (footwall edit, footwall import sticks)");
  }
  return made;
}

}  // namespace footwall::tasks
