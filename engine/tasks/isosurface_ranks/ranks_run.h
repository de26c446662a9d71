// `footwall bench isosurface --ranks`: one isosurface by several ranks, for many ways to cut the volume.
// Based on: seed 000, section 4 and its figure 2.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/pillars.h"
#include "engine/session/launch.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct RanksRun {
  std::filesystem::path raw;    // float32, little-endian, samples fastest
  survey::Index size{0, 0, 0};  // i, j, k
  float value = 0;
  std::string variant;  // of isosurface/registry.h
  std::vector<isosurface::Interleaving> interleavings;
  int repeats = 5;
  int threads = 1;  // of each rank
  bool normals = true;
  bool pyramid = false;  // bricks that the isovalue does not cross are skipped
};

// The words after footwall-engine that make it run this and write `result`.
std::vector<std::string> engine_words(const RanksRun& run, const std::filesystem::path& result);

// Collective; writes `result` on rank 0: {ranks, threads, triangles, vertices, chosen (what the automatic
// choice takes), rows[{pillars, mean_seconds, max_seconds, load_imbalance, wall_seconds,
// redundant_intersections, overlap_samples}]}. The samples are in memory before the time counts, each
// pillar's on their own, as in the paper. mean and max: processor time of the ranks; wall: until the slowest
// rank is done and all know their triangles' numbers; each of the repeat with the smallest max. Before that,
// the welded surface of each way is compared with the one of the whole volume, bit for bit. Throws the same
// Error on all ranks: kInternal where they differ, kNotFound, kFormat, kIo, kUsage, kCancelled.
void run_ranks(const comm::Communicator& parent, const RanksRun& run, const std::filesystem::path& result,
               const JobContext& job);

// Starts the engine and returns the text of the result.
std::string bench_isosurface_ranks(const RanksRun& run, const session::LaunchOptions& launch,
                                   const JobContext& job);

// 256 x 256 x 40 samples with a surface of some 46,000 triangles, most of it near the centre: the size of the
// paper's example. The isovalue is 0.
std::vector<float> central_volume();
inline constexpr survey::Index kCentralSize{256, 256, 40};

}  // namespace footwall::tasks
