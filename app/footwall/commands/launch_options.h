// The options of commands that start the engine.
#pragma once
#include <optional>

#include "app/footwall/console/program.h"
#include "engine/session/launch.h"

namespace footwall::commands {

struct EngineOptions {
  std::optional<int> ranks, threads;
  std::string running;  // --engine: one that runs already

  // running_too: with --engine, for commands whose jobs a running engine does.
  void add_to(CLI::App& command, bool running_too = false);
  void add_running_to(CLI::App& command);
  // Throws Error kUsage for numbers that cannot be, and for --ranks with --engine; as connection_from().
  session::LaunchOptions launch() const;
};

// The numbers of result.json that commands print, null where a job does not know them: faces, voxels, ranks,
// threads, exchange, balance, voxelizer, seconds, bytes_sent, messages, load_max_over_mean, load_deviation,
// pillars, cache_hits, cache_voxels, quickest_seconds, checksum.
void add_result(const console::Json& result, console::Json& output);
// "1200 faces, 54321 voxels on 4 ranks in 0.52 s; checksum 0123456789abcdef"
std::string result_in_words(const console::Json& result);

}  // namespace footwall::commands
