// Sets of faces to try things on without an engine.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/extract/face.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

// The faces of some EXTRACT-ALLs, one after the other, over one survey.
struct Extractions {
  survey::Index dims{0, 0, 0};
  std::vector<std::vector<extract::Face>> faces;
};
// Those of the first repeat of a workload script. Throws as parse_script, kInvalid without any EXTRACT-ALL.
Extractions extractions_of_script(const std::filesystem::path& path);
// Random meshes like those of the seed's workloads (workload/grow.h).
struct RandomFaces {
  survey::Index size{0, 0, 0};  // of the survey
  double area = 1000;           // mean, of a face, voxel^2
  std::int64_t faces = 10000;   // spread over 16 meshes, each of which has one more
  std::int64_t cycles = 1;      // EXTRACT-ALLs
  double distance = 10;         // mean length of the moves of all vertices in between, voxels
  std::uint64_t seed = 1;
};
// Throws kUsage for numbers that cannot be, kInvalid where vertices leave the lattice.
Extractions extractions_of(const RandomFaces& shape, const JobContext& job);
// The faces of a project's faults, once. Nothing is written. Throws as job_of_project.
Extractions extractions_of_project(project::Project& project, const JobContext& job);

}  // namespace footwall::tasks
