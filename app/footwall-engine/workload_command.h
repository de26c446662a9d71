// footwall-engine workload SCRIPT --result FILE
#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/tasks/workload/run_parallel.h"

namespace footwall::app {

// The command's words; those of tasks::engine_words().
class WorkloadCommand {
 public:
  explicit WorkloadCommand(CLI::App& app);
  bool parsed() const { return command_->parsed(); }
  // Collective; throws what run_workload throws.
  void run(const comm::Communicator& world);

 private:
  CLI::App* command_;
  std::string compute_, interleave_ = "1x1";
  tasks::WorkloadRun run_;
};

}  // namespace footwall::app
