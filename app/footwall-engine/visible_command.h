// footwall-engine bench-visible JOB: how long what can be seen of an isosurface takes.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "engine/comm/communicator.h"

namespace footwall::app {

class VisibleCommand {
 public:
  explicit VisibleCommand(CLI::App& app);
  bool parsed() const { return bench_->parsed(); }
  // Collective; throws what run_visible_bench() throws.
  void run(const comm::Communicator& world) const;

 private:
  CLI::App* bench_;
  std::string job_;
};

}  // namespace footwall::app
