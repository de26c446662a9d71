// footwall bench: figures that check their answer before they count the time.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/bench_extract.h"
#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/bench_voxelize.h"

namespace footwall::commands {
namespace {

console::Output bench_voxelize(const tasks::BenchVoxelizeOptions& options, const console::Console& console) {
  const tasks::BenchVoxelizeResult done = tasks::bench_voxelize(options, console.job());
  console::Output output;
  output.json = {{"voxelizer", done.voxelizer},
                 {"simd", done.simd},
                 {"threads", done.threads},
                 {"triangles", done.triangles},
                 {"voxels", done.voxels},
                 {"seconds", done.seconds},
                 {"seconds_min", done.seconds_min},
                 {"seconds_max", done.seconds_max},
                 {"voxels_per_second", done.voxels_per_second},
                 {"checked_triangles", done.checked_triangles},
                 {"counts", done.counts}};
  output.text = fmt::format(
      "{:<10} {:<10} {:>7} {:>10} {:>14} {:>12} {:>10} {:>10} {:>12}\n{:<10} {:<10} {:>7} {:>10} {:>14} "
      "{:>12.6f} {:>10.6f} {:>10.6f} {:>12.1f}\n",
      "voxelizer", "simd", "threads", "triangles", "voxels", "median s", "min s", "max s", "M voxels/s",
      done.voxelizer, done.simd, done.threads, done.triangles, done.voxels, done.seconds, done.seconds_min,
      done.seconds_max, done.voxels_per_second / 1e6);
  output.text +=
      fmt::format("{} triangles were compared with the definition first\n", done.checked_triangles);
  return output;
}

}  // namespace

void add_bench(console::Program& program) {
  CLI::App* group = program.add_group("bench", "Measure, after checking the answer");
  add_bench_extract(program, group);
  auto options = std::make_shared<tasks::BenchVoxelizeOptions>();
  CLI::App* command =
      program.add(group, "voxelize", "Voxelize the triangles of a file",
                  [options](console::Console& console) { return bench_voxelize(*options, console); });
  command->add_option("--triangles", options->triangles, "CSV: i0,j0,k0,i1,j1,k1,i2,j2,k2 a line, in voxels")
      ->required();
  command->add_option("--voxelizer", options->voxelizer, "exact (default)");
  command->add_option("--threads", options->threads, "Threads (default 1)");
  command->add_option("--repeats", options->repeats, "Timed runs; the median counts (default 5)");
  command->add_option("--list", options->list, "Write every voxel to this file: triangle,i,j,k a line");
}

}  // namespace footwall::commands
