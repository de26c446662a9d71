// What a bench checks of a voxelizer before it lets the clock run.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::tasks {

inline constexpr std::int64_t kFarthestVoxel = std::int64_t{1} << 24;
inline constexpr survey::Box kAllVoxels = {{-kFarthestVoxel, -kFarthestVoxel, -kFarthestVoxel},
                                           {kFarthestVoxel, kFarthestVoxel, kFarthestVoxel}};

struct VoxelizerCheck {
  std::int64_t triangles = 0;  // compared with the method's definition
  std::int64_t cubes = 0;      // voxels tested one by one for that
};

// Up to 64 triangles, evenly spread over the list. Of every method: rows in order, each voxel once, and the
// parts of a box cut in eight hold what the whole holds. Of `exact` and `kaufman`: the voxels are those of
// the definition, near the corners and the middle of large triangles; of `rotated`: those of the formulas,
// for triangles of up to 40,000 pixels. Throws Error kInternal where that is not so, kCancelled between
// triangles.
VoxelizerCheck check_voxelizer(const std::string& name, std::span<const survey::LatticeTriangle> triangles,
                               const JobContext& job);

// How a method's voxels differ from those of `exact`.
struct VoxelDifferences {
  std::int64_t triangles = 0;  // that were compared
  std::int64_t exact = 0;      // voxels that `exact` finds
  std::int64_t missed = 0;     // of these, not found
  std::int64_t extra = 0;      // found, and not among them
  std::int64_t repeated = 0;   // visits to a voxel that was visited before
};

// Compares evenly spread triangles until about `budget` voxels are seen, at least one; all of them where
// budget is 0.
VoxelDifferences differences_from_exact(const std::string& name,
                                        std::span<const survey::LatticeTriangle> triangles,
                                        std::int64_t budget, const JobContext& job);

}  // namespace footwall::tasks
