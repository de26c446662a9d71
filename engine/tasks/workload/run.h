// footwall workload run: starts the engine on a scripted workload.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/extract/face.h"
#include "engine/session/launch.h"

namespace footwall::tasks {

struct WorkloadRunOptions {
  std::filesystem::path script;
  session::LaunchOptions launch;  // ranks and threads
  extract::Options options;       // but threads
  std::uint64_t seed = 1;
  bool keep_cache = false;
};

// What follows footwall-engine on its command line.
std::vector<std::string> engine_words(const WorkloadRunOptions& options, const std::filesystem::path& result);

// The engine's answer, see run_parallel.h. Throws what session::run_engine throws; kNotFound without the
// script.
std::string run_workload_engine(const WorkloadRunOptions& options, const JobContext& job);

}  // namespace footwall::tasks
