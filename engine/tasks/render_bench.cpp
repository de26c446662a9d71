#include "engine/tasks/render_bench.h"

#include <fmt/format.h>

#include "engine/session/launcher.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

// Rank 0 may be on another host of an allocation.
fs::path home() {
  return session::current_allocation().slurm ? fs::current_path() : session::temporary_home();
}

}  // namespace

std::string bench_render(session::RenderBench bench, const session::LaunchOptions& launch,
                         const JobContext& job) {
  if (bench.repeat < 1 || bench.repeat > 1000)
    throw Error(ErrorCode::kUsage, fmt::format("--repeat {} makes no sense", bench.repeat), "give 1 to 1000");
  const session::PrivateFolder folder(home());
  bench.threads = launch.threads > 0 ? launch.threads : session::default_threads();
  bench.result = folder.path() / "result.json";
  if (!bench.scene.file.empty()) bench.scene.file = fs::absolute(bench.scene.file);
  const fs::path job_file = folder.path() / "BENCH.json";
  session::write_render_bench(bench, job_file);
  return session::run_engine(launch, {{"bench-render", job_file.string()}, bench.result}, job);
}

}  // namespace footwall::tasks
