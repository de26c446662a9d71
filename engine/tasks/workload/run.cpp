#include "engine/tasks/workload/run.h"

#include <fmt/format.h>

#include "engine/extract/registry.h"
#include "engine/session/launcher.h"
#include "engine/session/private_folder.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

int threads_of(const WorkloadRunOptions& options) {
  return options.launch.threads > 0 ? options.launch.threads : session::default_threads();
}

// Rank 0 may be on another host of an allocation, which shares the script's folder.
fs::path home_of_result(const fs::path& script) {
  if (session::current_allocation().slurm) return fs::absolute(script).parent_path();
  return session::temporary_home();
}

}  // namespace

std::vector<std::string> engine_words(const WorkloadRunOptions& options, const fs::path& result) {
  const extract::Options& o = options.options;
  std::vector<std::string> words{"workload", fs::absolute(options.script).string()};
  const auto add = [&](const char* name, std::string value) {
    words.emplace_back(name);
    words.push_back(std::move(value));
  };
  add("--result", fs::absolute(result).string());
  add("--exchange", o.exchange);
  add("--balance", o.balance);
  add("--voxelizer", o.voxelizer);
  if (!o.compute.empty()) add("--compute", fmt::format("{}", fmt::join(o.compute, ",")));
  add("--threads", std::to_string(threads_of(options)));
  add("--interleave", fmt::format("{}x{}", o.pillars[0], o.pillars[1]));
  add("--memory", std::to_string(o.cache_bytes));
  if (o.snr > 0) add("--snr", text::shortest(o.snr));
  add("--seed", std::to_string(options.seed));
  if (o.phases_apart) words.emplace_back("--phases-apart");
  if (options.keep_cache) words.emplace_back("--keep-cache");
  return words;
}

std::string run_workload_engine(const WorkloadRunOptions& options, const JobContext& job) {
  if (!fs::is_regular_file(options.script)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no workload {}", options.script.string()),
                "footwall workload make writes one");
  }
  // What cannot be is told without starting ranks.
  extract::Options checked = options.options;
  checked.threads = threads_of(options);
  extract::validate(checked);
  const session::PrivateFolder folder(home_of_result(options.script));
  const fs::path result = folder.path() / "result.json";
  return session::run_engine(options.launch, {engine_words(options, result), result}, job);
}

}  // namespace footwall::tasks
