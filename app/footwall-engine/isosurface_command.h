// footwall-engine isosurface JOB and bench-isosurface RAW ...
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/tasks/isosurface_ranks/ranks_run.h"

namespace footwall::app {

class IsosurfaceCommand {
 public:
  explicit IsosurfaceCommand(CLI::App& app);
  bool parsed() const { return extract_->parsed() || bench_->parsed(); }
  // Collective; throws what run_isosurface and run_ranks throw.
  void run(const comm::Communicator& world);

 private:
  CLI::App* extract_;
  CLI::App* bench_;
  std::filesystem::path job_, result_;
  std::string size_, pillars_;
  bool no_normals_ = false;
  tasks::RanksRun run_;
};

}  // namespace footwall::app
