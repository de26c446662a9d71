#include "app/footwall/commands/launch_options.h"

#include <fmt/format.h>

#include "engine/service/client/running_tasks.h"

namespace footwall::commands {
namespace {

// More ranks than this on one machine are a slip of the pen, which mpirun takes minutes to fail at.
constexpr int kMostRanks = 1024;

}  // namespace

void EngineOptions::add_running_to(CLI::App& command) {
  command.add_option(
      "--engine", running,
      "A running engine to use: @FILE that footwall serve wrote, or unix:PATH or tcp:HOST:PORT "
      "(default: one is started)");
}

void EngineOptions::add_to(CLI::App& command, bool running_too) {
  command.add_option(
      "--ranks", ranks,
      "MPI ranks (default: the tasks of Slurm's allocation, else the smaller of 4 and the usable "
      "cores)");
  command.add_option(
      "--threads", threads,
      "Threads of each rank (default: the processors of a task of Slurm's allocation, else 1)");
  if (running_too) add_running_to(command);
}

session::LaunchOptions EngineOptions::launch() const {
  if (ranks.value_or(1) < 1 || ranks.value_or(1) > kMostRanks) {
    throw Error(ErrorCode::kUsage, fmt::format("there cannot be {} ranks", *ranks),
                fmt::format("give 1 to {}, or leave --ranks out for the machine's own", kMostRanks));
  }
  if (threads.value_or(1) < 1) {
    throw Error(ErrorCode::kUsage, "--threads must be at least 1", "leave it out for the usual number");
  }
  session::LaunchOptions launch;
  launch.ranks = ranks.value_or(0);
  launch.threads = threads.value_or(0);
  if (running.empty()) return launch;
  if (ranks) {
    throw Error(ErrorCode::kUsage, "--ranks cannot be used with --engine: a running engine has its ranks",
                "leave one of the two out");
  }
  launch.running = service::running_tasks(service::connection_from(running));
  return launch;
}

void add_result(const console::Json& result, console::Json& output) {
  for (const char* key : {"faces", "voxels", "ranks", "threads", "exchange", "balance", "voxelizer",
                          "seconds", "bytes_sent", "messages", "load_max_over_mean", "checksum"}) {
    output[key] = result.at(key);
  }
  // A job that ended under an older program does not have these.
  for (const char* key : {"load_deviation", "pillars", "cache_hits", "cache_voxels", "quickest_seconds"}) {
    output[key] = result.value(key, console::Json());
  }
  output["faults"] = result.at("faults");
}

std::string result_in_words(const console::Json& result) {
  std::string text = fmt::format("{} faces, {} voxels", result.at("faces").get<std::int64_t>(),
                                 result.at("voxels").get<std::int64_t>());
  if (!result.at("ranks").is_null()) {
    text += fmt::format(" on {} ranks in {:.2f} s", result.at("ranks").get<int>(),
                        result.at("seconds").at("total").get<double>());
  }
  return text + "; checksum " + result.at("checksum").get<std::string>();
}

}  // namespace footwall::commands
