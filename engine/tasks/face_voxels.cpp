#include "engine/tasks/face_voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/extract/computations.h"
#include "engine/extract/face_rows.h"
#include "engine/extract/lot.h"
#include "engine/tasks/face_tables.h"
#include "engine/tasks/triangulate.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kMostAlongAxis = 1 << 23;  // voxels of a survey

// What attach wrote down, see voxel_parameters() there.
struct Parameters {
  std::string voxelizer;
  survey::Index origin{0, 0, 0};
  survey::Index dims{0, 0, 0};
};

Parameters parameters_of(const project::FaceVoxels& kept, std::int64_t run) {
  try {
    const Json json = Json::parse(kept.parameters);
    Parameters parameters;
    json.at("voxelizer").get_to(parameters.voxelizer);
    json.at("origin").get_to(parameters.origin);
    json.at("dims").get_to(parameters.dims);
    for (const std::int64_t each : parameters.origin) {
      if (each < 0 || each > kMostAlongAxis) throw Error(ErrorCode::kCorrupt, "no place");
    }
    for (const std::int64_t each : parameters.dims) {
      if (each < 0 || each > kMostAlongAxis) throw Error(ErrorCode::kCorrupt, "no size");
    }
    return parameters;
  } catch (const std::exception&) {
    throw Error(ErrorCode::kCorrupt, fmt::format("run {} does not say how its voxels were kept", run),
                "compute it again with footwall extract");
  }
}

// What a run has of a fault: the first in the order of the registry, so exact values before coded ones.
const project::FaceVoxels* best_of(const std::vector<project::FaceVoxels>& all) {
  for (const extract::Computation& row : extract::computations()) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const project::FaceVoxels& each) { return each.codec == row.name; });
    if (found != all.end()) return &*found;
  }
  return nullptr;
}

void read_fault(const project::FaultRun& run, const std::string& fault, const project::FaceVoxels& kept,
                const Parameters& parameters, FaceVoxelsRead& read,
                const std::function<void(const VoxelsOfFace&)>& visit, const JobContext& job) {
  const std::unique_ptr<voxelize::Voxelizer> voxelizer = voxelize::make_voxelizer(parameters.voxelizer);
  extract::VoxelReader reader(kept.codec);
  extract::FaceRows rows;
  std::vector<float> values;
  std::vector<survey::Index> voxels;
  const survey::Box box{{0, 0, 0}, parameters.dims};
  for (std::size_t f = 0; f < run.lattice.size(); ++f) {
    job.check();
    rows.clear();
    voxelizer->rows(survey::in_volume(run.lattice[f], parameters.origin), box, rows);
    const std::uint64_t first = f == 0 ? 0 : kept.ends[f - 1];
    reader.read(std::span(kept.bytes).subspan(first, kept.ends[f] - first), rows, values);
    voxels.clear();
    rows.for_each([&](const survey::Index& p) {
      voxels.push_back(
          {p[0] + parameters.origin[0], p[1] + parameters.origin[1], p[2] + parameters.origin[2]});
    });
    visit({fault, face_id(run.panels[f], run.numbers[f]), voxels, values});
    ++read.faces;
    read.voxels += rows.voxels();
  }
}

}  // namespace

FaceVoxelsRead read_face_voxels(const project::Project& project, const std::string& fault,
                                std::optional<std::int64_t> run,
                                const std::function<void(const VoxelsOfFace&)>& visit,
                                const JobContext& job) {
  FaceVoxelsRead read;
  const auto chosen = chosen_run(project, run);
  if (!chosen) throw Error(ErrorCode::kNotFound, "the project has no run", "footwall extract makes one");
  read.run = chosen->id;
  const std::vector<std::int64_t> in_run = project.run_faults(read.run);
  const std::vector<project::FaultRecord> faults = chosen_faults(project, fault);
  for (std::size_t n = 0; n < faults.size(); ++n) {
    if (std::find(in_run.begin(), in_run.end(), faults[n].id) == in_run.end()) continue;
    job.report(static_cast<double>(n) / static_cast<double>(faults.size()), "export", faults[n].name);
    const std::vector<project::FaceVoxels> kept = project.face_voxels(read.run, faults[n].id);
    const project::FaceVoxels* best = best_of(kept);
    if (best == nullptr) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("run {} kept no voxels of fault {}", read.run, faults[n].name),
                  "footwall extract --compute lot --snr 30 keeps them, or --compute voxels, without loss");
    }
    read.codec = best->codec;
    read_fault(project.fault_statistics(read.run, faults[n].id), faults[n].name, *best,
               parameters_of(*best, read.run), read, visit, job);
  }
  return read;
}

}  // namespace footwall::tasks
