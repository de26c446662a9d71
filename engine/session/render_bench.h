// Measures drawing on all ranks: the answer first, then the time.
#pragma once
#include <filesystem>
#include <optional>

#include "engine/comm/communicator.h"
#include "engine/session/render_bench_source.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// On disk as JSON: {footwall_render_bench: 1, width, height, threads, repeat, group_threshold, scene: {kind,
// file, dims, value, triangles, pyramid}, result}.
struct RenderBench {
  int width = 1024;
  int height = 1024;
  int threads = 1;  // of each rank
  int repeat = 5;
  std::optional<double> group_threshold = 0.1;  // none: by estimated times (group_options.h)
  BenchedScene scene;
  // {ranks, threads, triangles, pixels, picture, seconds[], phases: {extract, group, project, rasterize,
  // shade, merge, gather, assemble}, mtriangles_per_second: {...}, merged_bytes, merged_pixels, bytes_sent,
  // messages, group_steps, samples_mib, pyramid_seconds}. seconds: from the isovalue (a mesh: its vertices)
  // to the picture of RGBA and depth on rank 0, the slowest rank's. phases: medians over the repeats of the
  // slowest rank's.
  std::filesystem::path result;
};

// Throws kIo, kUnsupported.
void write_render_bench(const RenderBench& bench, const std::filesystem::path& path);
// Throws kNotFound, kFormat.
RenderBench read_render_bench(const std::filesystem::path& path);

// Collective; the same Error on every rank. Before anything is measured rank 0 gets all triangles and draws
// them alone, one after the other, without vectors; throws kInternal where a pixel differs, and where a
// repeat gives another picture.
void run_render_bench(const comm::Communicator& parent, const std::filesystem::path& job_path,
                      const JobContext& context);

}  // namespace footwall::session
