#include "engine/tasks/replay_project.h"

#include <fmt/format.h>

#include "engine/service/wire.h"
#include "engine/tasks/fault_faces.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

void open_volumes(const project::Project& project, service::EngineClient& engine, Replayed& done,
                  const JobContext& job) {
  const std::vector<project::VolumeRecord> volumes = project.volumes();
  const auto count = static_cast<double>(volumes.size());
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    const project::VolumeRecord& volume = volumes[n];
    v1::VolumeName name;
    name.set_checksum(volume.checksum);
    name.set_path(std::filesystem::absolute(project.volume_path(volume)).string());
    try {
      const auto at = static_cast<double>(n);
      engine.open_volume(name, job.part(at / count, (at + 1) / count));
      done.volumes.push_back(volume.name);
    } catch (const Error& error) {
      // The others may well be of use.
      if (error.code() == ErrorCode::kEngine || error.code() == ErrorCode::kCancelled) throw;
      done.notices.push_back(fmt::format("volume {} is left out: {}", volume.name, error.what()));
    }
  }
}

}  // namespace

Replayed replay_project(project::Project& project, service::EngineClient& engine, const JobContext& job) {
  Replayed done;
  open_volumes(project, engine, done, job.part(0, 0.8));
  v1::EditBatch batch;
  batch.set_edit(engine.status().edit() + 1);
  batch.add_edits()->set_clear(true);
  engine.edit(batch);
  const std::optional<survey::Geometry> survey = project.survey();
  if (!survey) return done;
  const survey::Lattice lattice(*survey);
  MeshNotes notes;
  const std::vector<project::FaultRecord> faults = project.faults();
  for (std::size_t n = 0; n < faults.size(); ++n) {
    const auto at = [&](std::size_t fault) {
      return 0.8 + 0.2 * static_cast<double>(fault) / static_cast<double>(faults.size());
    };
    const JobContext part = job.part(at(n), at(n + 1));
    part.report(0, "model", fmt::format("{} of {} faults", n, faults.size()));
    const auto mesh = fresh_mesh(project, faults[n], false, FreshMeshes::kThrownAway, notes, part);
    if (!mesh) continue;
    // One batch each, so that no message grows with the project.
    const std::uint64_t edit = batch.edit() + 1;
    batch.Clear();
    batch.set_edit(edit);
    v1::ReplaceFault& replace = *batch.add_edits()->mutable_replace();
    replace.set_fault(faults[n].id);
    *replace.mutable_faces() = service::message_of(fault_faces(faults[n], *mesh, lattice, {0, 0, 0}));
    done.faces = engine.edit(batch).faces();
  }
  for (const std::string& skipped : notes.skipped) done.notices.push_back("fault is left out: " + skipped);
  job.report(1, "model");
  return done;
}

}  // namespace footwall::tasks
