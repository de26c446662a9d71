// `footwall bench visible`: only what can be seen of an isosurface, on several numbers of ranks.
// Based on: seed 003, section 4: its tables 1 to 6 and figures 7 to 11 are made of these numbers.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/session/launch.h"
#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

struct VisibleView {
  double azimuth = 0;
  double elevation = 0;
};

// On disk as JSON: {footwall_visible_bench: 1, raw, size, value, mode, views: [[azimuth, elevation]],
// perspective, width, height, cell, estimate_cells: [], threads, repeats, result}.
struct VisibleBench {
  std::filesystem::path raw;    // float32, little-endian, samples (x of the picture) fastest
  survey::Index size{0, 0, 0};  // i, j, k: z, y, x of the picture
  float value = 0;
  std::string mode = "depth";  // or "paper"
  std::vector<VisibleView> views;
  bool perspective = true;
  int width = 1024;
  int height = 1024;
  survey::Index cell{0, 0, 0};  // of the octree, lattice cells; 0: chosen
  // In which work is estimated; each is measured.
  std::vector<survey::Index> estimate_cells;
  int threads = 1;  // of each rank
  int repeats = 5;
  // {ranks, threads, size, value, mode, perspective, width, height, cell, whole[{view, triangles, pixels,
  // triangles_seen, extract_seconds, draw_seconds}], rows[{view, estimate_cell, triangles, finished,
  // seconds[], median_seconds, busy_seconds, draw_seconds, load_difference, pixels, pixels_farther,
  // pixels_lost, passes[{cells, triangles, load_difference, uncovered_pixels, percent, seconds{visibility,
  // partition, assign, extract, composite}, busy_seconds{host, extract}}]}]}. `whole`: the whole surface,
  // extracted and drawn by rank 0 alone. seconds: from the isovalue until the last pass is done, the slowest
  // rank's. busy_seconds: processor time, of rank 0 in visibility and partition (host) and of the slowest
  // rank in `extract`; of a row, all passes: what ranks that share cores would need with a core each,
  // messages left out. pixels_farther: that show something behind what is seen of the whole surface;
  // pixels_lost: that show nothing where the whole surface is. busy_seconds is null in mode depth.
  std::filesystem::path result;
};

// Throws kIo, kUnsupported (a path that is not UTF-8).
void write_visible_bench(const VisibleBench& bench, const std::filesystem::path& path);
// Throws kNotFound, kFormat.
VisibleBench read_visible_bench(const std::filesystem::path& path);

// Collective; the same Error on all ranks: kNotFound, kFormat, kUsage for a mode that is not there,
// kCancelled; kInternal where a picture shows something nearer than the whole surface, which cannot be.
void run_visible_bench(const comm::Communicator& parent, const std::filesystem::path& job_path,
                       const JobContext& job);

// Starts the engine for each mode and number of ranks; bench.mode is not looked at. Returns the text of
// {runs: [what run_visible_bench() wrote]}. Throws kInternal where passes are not the same for all numbers of
// ranks, and what the engine throws.
std::string bench_visible(VisibleBench bench, const std::vector<std::string>& modes,
                          const std::vector<int>& ranks, session::LaunchOptions launch,
                          const JobContext& job);

}  // namespace footwall::tasks
