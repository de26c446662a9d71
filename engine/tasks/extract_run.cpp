#include "engine/tasks/extract_run.h"

#include <fmt/format.h>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/extract/registry.h"
#include "engine/session/job.h"
#include "engine/session/part_file.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/survey/lattice.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

project::VolumeRecord present_volume(const project::Project& project, const std::string& name) {
  project::VolumeRecord volume = project.volume(name);
  for (const project::MissingFile& missing : project.missing()) {
    if (missing.volume != volume.name) continue;
    throw Error(ErrorCode::kNotFound,
                fmt::format("the volume '{}' {}: {}", volume.name, missing.reason, missing.path.string()),
                fmt::format("footwall relink {} FILE tells where it is now", project.path().string()));
  }
  return volume;
}

// Fresh meshes for the faults asked for; those that cannot be made a surface are skipped and named.
std::vector<project::FaultRecord> with_meshes(project::Project& project, const std::string& name,
                                              Extracted& done, const JobContext& job) {
  std::vector<project::FaultRecord> ready;
  for (const project::FaultRecord& fault : chosen_faults(project, name)) {
    if (project.mesh_is_stale(fault.id)) {
      try {
        log::info(
            fmt::format("triangulating {} first: its pillars changed since its mesh was made", fault.name));
        triangulate_fault(project, fault, {}, job);
        done.triangulated.push_back(fault.name);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::kInvalid || !name.empty()) throw;
        log::warn(fmt::format("{} is left out: {}", fault.name, error.message()));
        done.skipped.push_back(fault.name + ": " + error.message());
        continue;
      }
    }
    ready.push_back(fault);
  }
  if (ready.empty()) {
    throw Error(ErrorCode::kInvalid, "no fault has a surface to extract",
                "pick at least two pillars on a fault (footwall edit, footwall import sticks)");
  }
  return ready;
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
  session::JobFault out{fault.id, fault.name, {}};
  out.faces.reserve(mesh.faces.size());
  for (const project::MeshFace& face : mesh.faces) {
    const auto at = [&](int corner) {
      return points[static_cast<std::size_t>(face.vertices[static_cast<std::size_t>(corner)])];
    };
    out.faces.push_back({fault.id, face.panel, face.n, {at(0), at(1), at(2)}});
  }
  return out;
}

project::FaultRun fault_run(const session::Part& part, const project::MeshRecord& mesh,
                            const survey::Index& origin) {
  project::FaultRun run;
  run.fault = part.fault;
  run.fault_name = part.name;
  run.revision = mesh.revision;
  const auto shift = [&](int axis) {
    return static_cast<std::int32_t>(origin[static_cast<std::size_t>(axis)] * survey::kLatticePerVoxel);
  };
  for (const extract::Face& face : part.faces) {
    run.panels.push_back(face.owner);
    run.numbers.push_back(face.n);
    survey::LatticeTriangle triangle = face.triangle;
    for (survey::LatticePoint& p : triangle) p = {p.i + shift(0), p.j + shift(1), p.k + shift(2)};
    run.lattice.push_back(triangle);
  }
  run.statistics = columns_of(part);
  return run;
}

}  // namespace

Extracted extract_run(project::Project& project, const ExtractOptions& options, const JobContext& job) {
  extract::validate(options.engine);
  if (!options.name.empty()) project::check_name("run", options.name);
  const survey::Geometry survey = required_survey(project, "EXTRACT-ALL");
  const project::VolumeRecord volume = present_volume(project, options.volume);

  Extracted done;
  done.volume = volume.name;
  const std::vector<project::FaultRecord> faults =
      with_meshes(project, options.fault, done, job.part(0, 0.05));

  session::Job batch;
  batch.volume = std::filesystem::absolute(project.volume_path(volume));
  batch.volume_checksum = volume.checksum;
  batch.geometry = open_volume(project, volume).info().geometry;
  batch.options = options.engine;
  batch.options.threads = options.launch.threads;
  batch.velocity = options.velocity;
  const survey::Lattice lattice(survey);
  std::map<std::int64_t, project::MeshRecord> meshes;
  for (const project::FaultRecord& fault : faults) {
    const project::MeshRecord& mesh = meshes.emplace(fault.id, project.mesh(fault.id).value()).first->second;
    batch.faults.push_back(job_fault(fault, mesh, lattice, volume.origin));
  }

  const session::PrivateFolder folder(session::temporary_home());
  batch.output = folder.path() / "parts";
  const fs::path job_file = folder.path() / "JOB.json";
  session::write_job(batch, job_file);
  done.result_json = session::run_engine(options.launch, job_file, job.part(0.05, 0.98));

  std::vector<project::FaultRun> runs;
  runs.reserve(faults.size());
  for (const project::FaultRecord& fault : faults) {
    runs.push_back(fault_run(session::read_part(session::part_path(batch.output, fault.id)),
                             meshes.at(fault.id), volume.origin));
  }
  project.register_statistics(stored_statistics());
  project::RunRecord record;
  record.name = options.name;
  record.volume = volume.name;
  record.volume_checksum = volume.checksum;
  record.parameters =
      nlohmann::json{{"exchange", options.engine.exchange},
                     {"balance", options.engine.balance},
                     {"voxelizer", options.engine.voxelizer},
                     {"compute", options.engine.compute},
                     {"velocity", options.velocity ? nlohmann::json(*options.velocity) : nlohmann::json()}}
          .dump();
  record.result = done.result_json;
  done.run = project.add_run(record, runs);
  job.report(1, "attached");
  return done;
}

}  // namespace footwall::tasks
