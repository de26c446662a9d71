// footwall-engine render JOB and bench-render JOB: pictures of isosurfaces, and how long they take.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "engine/comm/communicator.h"

namespace footwall::app {

class RenderCommand {
 public:
  explicit RenderCommand(CLI::App& app);
  bool parsed() const { return render_->parsed() || bench_->parsed(); }
  void run(const comm::Communicator& world) const;

 private:
  CLI::App* render_;
  CLI::App* bench_;
  std::string job_;
};

}  // namespace footwall::app
