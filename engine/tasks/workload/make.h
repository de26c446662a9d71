// footwall workload make: the seed's genscript.
// Based on: seed 004, appendix B.1.1 and section 5.2.1.
#pragma once
#include <cstdint>
#include <filesystem>

#include "engine/tasks/workload/script.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct WorkloadShape {
  survey::Index size{0, 0, 0};  // of the survey, in voxels
  double area = 0;              // mean area of the faces when they are made, voxel^2
  // ADD-FACEs of a repeat, spread over the meshes; each mesh is created with one face more.
  std::int64_t faces = 0;
  std::int64_t meshes = 16;
  std::int64_t cycles = 0;   // EXTRACT-ALLs of a repeat
  double distance = 0;       // mean length of a vertex's move, voxels
  std::int64_t repeats = 0;  // each with other meshes
  double move_fraction = 1;  // of the vertices, moved before an EXTRACT-ALL
  bool move_first = false;   // also before the first (section 5.2.1) instead of before each but the first
  std::uint64_t seed = 1;
};

struct MadeWorkload {
  OperationCounts operations;
  double mean_area = 0;            // of all faces when they are made, voxel^2
  double mean_area_extracted = 0;  // of all faces of all EXTRACT-ALLs
  std::int64_t faces = 0;          // made
  std::int64_t faces_outside = 0;  // of them, not wholly inside the survey when made
};

// How far the mean area may be from what was asked before it is worth a warning.
inline constexpr double kAreaTolerance = 0.05;

// Writes the script, which takes its name when whole. The same shape gives the same bytes on every machine.
// Throws Error kUsage for a shape that cannot be, kInvalid where faces leave the lattice, kIo, kCancelled.
MadeWorkload make_workload(const WorkloadShape& shape, const std::filesystem::path& path,
                           const JobContext& job = {});

}  // namespace footwall::tasks
