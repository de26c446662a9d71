// `footwall bench voxelize --gather`: spans, values and moments together, as one rank folds its faces.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "storage/base/job_context.h"

namespace footwall::tasks {

struct GatherOptions {
  bool from_memory = false;  // a volume of 400 x 400 x 200 values (128 MB) instead of 96 x 96 x 96 (3.4 MB)
  std::string voxelizer = "exact";
  std::vector<double> areas = {1e3, 1e4, 1e5};  // mean areas in voxel^2; areas that do not fit are cut off
  std::int64_t voxels = 20'000'000;             // about how many a run walks
  int runs = 5;
};

// Rates in voxels for a second of processor time on one thread, medians over the runs.
struct GatherRow {
  double area = 0;
  std::int64_t faces = 0;
  std::int64_t voxels = 0;
  double spans = 0;           // voxelized and counted
  double folded = 0;          // with gather and moments, faces in the order of the list (random places)
  double folded_ordered = 0;  // the same in the order of FaceOrder
};

struct GatherResult {
  std::string simd;
  std::array<std::int64_t, 3> dims{};
  std::vector<GatherRow> rows;
  std::int64_t checked_faces = 0;  // whose statistics were compared with the definition first
};

// Random faces of 0.5 to 1.5 times the mean area in random orientation, uniform in the volume; values are a
// hash of the index. Throws Error kUsage for options out of range, kInternal if a face's sums are wrong.
GatherResult bench_gather(const GatherOptions& options, const JobContext& job);

}  // namespace footwall::tasks
