// An engine that is kept running for whoever has its connection file, until it is told to stop.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "engine/service/client/engine_process.h"
#include "engine/tasks/replay_project.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct ServeOptions {
  std::filesystem::path project;     // whose volumes and model it is to have; empty: none
  std::filesystem::path connection;  // the file to write; empty: service::default_connection_file()
  service::EngineProcessOptions engine;
};

struct ServeEvents {
  // It serves, for the first time or again.
  std::function<void(const service::Connection& connection, const std::filesystem::path& file,
                     const Replayed& replayed)>
      ready;
  // It died, which words say how, and will be started again.
  std::function<void(const std::string& words)> died;
};

struct Served {
  service::Connection connection;  // the last one, without its token
  std::filesystem::path file;
  int starts = 0;
  double seconds = 0;
};

// Returns when a client has stopped the engine, or the job was cancelled; the connection file is gone then,
// and all processes. Where the engine dies it is started again, with the same token, and the project is
// replayed from what it is by then. Throws kHeld where the project (or, without one, the connection file) is
// served already, naming by whom; kEngine where the engine cannot be started or died three times within a
// minute.
Served serve(const ServeOptions& options, const ServeEvents& events, const JobContext& job);

}  // namespace footwall::tasks
