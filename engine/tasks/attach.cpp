#include "engine/tasks/attach.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/extract/extract.h"
#include "engine/extract/lot.h"
#include "engine/session/fault_summary.h"
#include "engine/session/part_file.h"
#include "engine/tasks/statistics.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/survey/lattice.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kResultLimit = std::size_t{256} << 20;
constexpr const char* kJobKey = "job";  // in RunRecord::parameters

bool earlier(const survey::LatticeTriangle& a, const survey::LatticeTriangle& b) {
  const auto key = [](const survey::LatticeTriangle& t) {
    return std::tie(t[0].i, t[0].j, t[0].k, t[1].i, t[1].j, t[1].k, t[2].i, t[2].j, t[2].k);
  };
  return key(a) < key(b);
}

project::FaultRun fault_run(const session::Part& part, std::int64_t revision, const survey::Index& origin) {
  project::FaultRun run;
  run.fault = part.fault;
  run.fault_name = part.name;
  run.revision = revision;
  for (const extract::Face& face : part.faces) {
    run.panels.push_back(face.owner);
    run.numbers.push_back(face.n);
    run.lattice.push_back(survey::in_survey(face.triangle, origin));
  }
  run.statistics = columns_of(part);
  return run;
}

// What it takes to read the voxels of a run back: which voxels a face has, and in which volume.
std::string voxel_parameters(const session::Job& job) {
  return Json{{"voxelizer", job.options.voxelizer},
              {"origin", job.volume_origin},
              {"dims", job.geometry.dims()},
              {"snr", job.options.snr},
              {"order", job.options.lot_order}}
      .dump();
}

// `lot` without a ratio has no bytes at all: nothing to keep.
std::vector<project::FaceVoxels> face_voxels(const session::Part& part, const session::Job& job) {
  std::vector<project::FaceVoxels> all;
  for (const extract::FaceBlobs& blobs : part.blobs) {
    const bool transform_alone = blobs.computation == "lot" && job.options.snr == 0;
    if (transform_alone || !extract::holds_voxels(blobs.computation)) continue;
    all.push_back({blobs.computation,
                   voxel_parameters(job),
                   {blobs.offsets.begin() + 1, blobs.offsets.end()},
                   blobs.bytes});
  }
  return all;
}

fs::path job_file_in(const fs::path& folder) {
  if (fs::is_regular_file(folder)) return folder;
  if (fs::exists(folder / "JOB.json")) return folder / "JOB.json";
  throw Error(ErrorCode::kNotFound, fmt::format("there is no job in {}", folder.string()),
              "name the folder that footwall extract --write-job made, or a copy of it");
}

// The volume that the job is about, by its checksum: it may have another name by now.
project::VolumeRecord volume_of(const project::Project& project, const session::Job& job) {
  std::vector<project::VolumeRecord> same = project.volumes();
  std::erase_if(same, [&](const project::VolumeRecord& v) {
    return v.checksum != job.volume_checksum || v.origin != job.volume_origin;
  });
  if (same.empty()) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the results are of volume {} with checksum {}, which the project does not have",
                            job.volume_name, job.volume_checksum),
                "attach them to the project that the job was written from");
  }
  const auto named = std::find_if(same.begin(), same.end(),
                                  [&](const project::VolumeRecord& v) { return v.name == job.volume_name; });
  return named != same.end() ? *named : same.front();
}

// Whether any triangle of the results is still one of the fault's present mesh.
bool shares_a_face(const project::Project& project, const session::Job& job, const session::JobFault& fault) {
  const auto mesh = project.mesh(fault.id);
  const auto survey = project.survey();
  if (!mesh || !survey) return false;
  const survey::Lattice lattice(*survey);
  std::vector<survey::LatticeTriangle> now;
  for (const project::MeshFace& face : mesh->faces) {
    survey::LatticeTriangle& triangle = now.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      triangle[c] = lattice.from_world(mesh->vertices[static_cast<std::size_t>(face.vertices[c])].position);
  }
  std::sort(now.begin(), now.end(), earlier);
  return std::any_of(fault.faces.begin(), fault.faces.end(), [&](const extract::Face& face) {
    return std::binary_search(now.begin(), now.end(), survey::in_survey(face.triangle, job.volume_origin),
                              earlier);
  });
}

void require_faults(const project::Project& project, const session::Job& job) {
  const std::vector<project::FaultRecord> faults = project.faults();
  for (const session::JobFault& fault : job.faults) {
    const auto found = std::find_if(faults.begin(), faults.end(),
                                    [&](const project::FaultRecord& known) { return known.id == fault.id; });
    if (found == faults.end()) {
      throw Error(ErrorCode::kNotFound,
                  fmt::format("the results are of fault {} (id {}), which the project does not have",
                              fault.name, fault.id),
                  "was it deleted, or is this another project? footwall undo brings a deleted fault back");
    }
    if (found->name != fault.name) {
      if (!shares_a_face(project, job, fault)) {
        throw Error(
            ErrorCode::kInvalid,
            fmt::format("the results are of fault {}; the project's fault {} is called {} and has no face "
                        "in common with it",
                        fault.name, fault.id, found->name),
            "attach them to the project that the job was written from");
      }
      log::warn(fmt::format("fault {} was called {} when the job was written", found->name, fault.name));
    }
  }
}

// The faults with faces that are no longer there, or elsewhere.
std::vector<StaleFault> stale_faults(const project::Project& project, const session::Job& job,
                                     const std::vector<std::size_t>& faults, std::int64_t run) {
  std::vector<StaleFault> all;
  for (const std::size_t n : faults) {
    const session::JobFault& fault = job.faults[n];
    const std::vector<bool> stale = project.stale_faces(run, fault.id);
    const auto count = std::count(stale.begin(), stale.end(), true);
    if (count == 0) continue;
    all.push_back({project.fault(fault.id).name, static_cast<std::int64_t>(stale.size()), count});
  }
  return all;
}

std::string hash_of(const session::Job& job, const std::vector<std::size_t>& faults) {
  session::Job attached = job;
  attached.faults.clear();
  for (const std::size_t n : faults) attached.faults.push_back(job.faults[n]);
  return to_hex(session::job_hash(attached));
}

void refuse_a_second_time(const project::Project& project, const std::string& hash) {
  for (const project::RunRecord& run : project.runs()) {
    const Json parameters = Json::parse(run.parameters, nullptr, false);
    if (!parameters.is_object() || parameters.value(kJobKey, "") != hash) continue;
    throw Error(ErrorCode::kInvalid, fmt::format("these results are attached already, as run {}", run.id),
                fmt::format("footwall faces {} --run {} shows them", project.path().string(), run.id));
  }
}

// What there is of the engine's answer: of a job that has not ended, the parts alone are known.
Json result_of(const session::Job& job, const std::vector<std::size_t>& faults) {
  std::vector<extract::Face> faces;
  std::vector<extract::FaceStatistics> statistics;
  Json wholes = Json::array();
  std::int64_t voxels = 0;
  for (const std::size_t n : faults) {
    const session::Part part = session::read_part(session::part_path(job.output, job.faults[n].id));
    faces.insert(faces.end(), part.faces.begin(), part.faces.end());
    wholes.push_back(session::fault_summary(part.whole));
    wholes.back().update({{"fault", part.fault}, {"name", part.name}, {"faces", part.faces.size()}});
    statistics.insert(statistics.end(), part.statistics.begin(), part.statistics.end());
    for (const extract::FaceStatistics& face : part.statistics) voxels += face.count + face.nulls;
  }
  Json result{{"faces", faces.size()},
              {"voxels", voxels},
              {"faults", wholes},
              {"checksum", to_hex(extract::checksum_of(faces, statistics))},
              {"voxelizer", job.options.voxelizer}};
  for (const char* unknown :
       {"ranks", "threads", "exchange", "balance", "seconds", "bytes_sent", "messages", "load_max_over_mean",
        "load_deviation", "pillars", "cache_hits", "cache_voxels", "quickest_seconds"}) {
    result[unknown] = nullptr;
  }
  const fs::path path = job.output / "result.json";
  if (faults.size() < job.faults.size() || !fs::exists(path)) return result;
  const Json whole = Json::parse(read_whole_file(path, kResultLimit), nullptr, false);
  const bool fits =
      whole.is_object() && std::all_of(result.items().begin(), result.items().end(),
                                       [&](const auto& item) { return whole.contains(item.key()); });
  if (!fits || whole["checksum"] != result["checksum"]) {
    throw Error(ErrorCode::kCorrupt, path.string() + " is not the summary of the parts beside it",
                "run the job again: it takes the parts that are whole, and writes the summary anew");
  }
  return whole;
}

}  // namespace

std::int64_t attach_parts(project::Project& project, const session::Job& job,
                          const std::vector<std::size_t>& faults, const std::string& result_json,
                          const std::string& job_name) {
  std::vector<project::FaultRun> runs;
  runs.reserve(faults.size());
  for (const std::size_t n : faults) {
    const session::JobFault& fault = job.faults[n];
    const session::Part part = session::read_part(session::part_path(job.output, fault.id));
    runs.push_back(fault_run(part, fault.revision, job.volume_origin));
    runs.back().voxels = face_voxels(part, job);
  }
  project.register_statistics(stored_statistics());
  project::RunRecord record;
  record.name = job.run;
  record.volume = volume_of(project, job).name;
  record.volume_checksum = job.volume_checksum;
  Json parameters{{"exchange", job.options.exchange},
                  {"balance", job.options.balance},
                  {"voxelizer", job.options.voxelizer},
                  {"compute", job.options.compute},
                  {"velocity", job.velocity ? Json(*job.velocity) : Json()}};
  if (!job_name.empty()) parameters[kJobKey] = job_name;
  record.parameters = parameters.dump();
  record.result = result_json;
  return project.add_run(record, runs);
}

Attached attach_folder(project::Project& project, const fs::path& folder, const AttachOptions& options,
                       const JobContext& context) {
  session::Job job = session::read_job(job_file_in(folder));
  if (!options.name.empty()) job.run = options.name;
  if (!job.run.empty()) project::check_name("run", job.run);
  Attached attached;
  attached.volume = volume_of(project, job).name;
  require_faults(project, job);

  // Which parts are there; one that is there and not of this job is no missing one.
  std::vector<std::size_t> there;
  for (std::size_t n = 0; n < job.faults.size(); ++n) {
    const session::JobFault& fault = job.faults[n];
    context.report(static_cast<double>(n) / static_cast<double>(job.faults.size()), "read", fault.name);
    const fs::path path = session::part_path(job.output, fault.id);
    if (!fs::exists(path)) {
      attached.missing.push_back(fault.name);
      continue;
    }
    const session::Part part = session::read_part(path);
    if (part.hash != session::part_hash(job, fault) || part.faces != fault.faces) {
      throw Error(ErrorCode::kInvalid, fmt::format("{} holds results of another job", path.string()),
                  "run the job again: it replaces them");
    }
    there.push_back(n);
  }
  if (there.empty() || (!attached.missing.empty() && !options.partial)) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("{} of {} faults are not computed yet: {}", attached.missing.size(),
                            job.faults.size(), fmt::join(attached.missing, ", ")),
                there.empty()
                    ? "run the job first (README.txt beside it says how)"
                    : "run the job again: it goes on where it stopped; --partial attaches what there is");
  }
  const std::string hash = hash_of(job, there);
  refuse_a_second_time(project, hash);
  attached.result_json = result_of(job, there).dump();
  attached.run = attach_parts(project, job, there, attached.result_json, hash);
  attached.stale = stale_faults(project, job, there, attached.run);
  context.report(1, "attached");
  return attached;
}

}  // namespace footwall::tasks
