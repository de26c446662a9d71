// The voxel values that a run kept of its faces, read back.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "storage/base/job_context.h"
#include "storage/project/project.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

struct VoxelsOfFace {
  const std::string& fault;
  std::string face;                       // face_id()
  std::span<const survey::Index> voxels;  // in the survey, in the voxelizer's order
  std::span<const float> values;          // of them; NaN = null
};

struct FaceVoxelsRead {
  std::int64_t run = 0;
  // The computation that made them: "voxels" (the values themselves), "lot" (within the signal-to-noise ratio
  // of the run), "filter" ..
  std::string codec;
  std::int64_t faces = 0;
  std::int64_t voxels = 0;
};

// Calls visit for every face of the run (none: the last one), fault by fault; spans are valid during the
// call. fault: empty for all. A run that kept both gives the values themselves. Throws kNotFound (run or
// fault), kInvalid where the run kept no voxels, kCorrupt, kCancelled.
FaceVoxelsRead read_face_voxels(const project::Project& project, const std::string& fault,
                                std::optional<std::int64_t> run,
                                const std::function<void(const VoxelsOfFace&)>& visit, const JobContext& job);

}  // namespace footwall::tasks
