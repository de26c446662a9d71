#include "app/footwall-engine/render_command.h"

#include "app/footwall-engine/running_job.h"
#include "engine/session/render_bench.h"
#include "engine/session/render_job.h"

namespace footwall::app {

RenderCommand::RenderCommand(CLI::App& app)
    : render_(app.add_subcommand("render", "draws isosurfaces; footwall render starts it")),
      bench_(app.add_subcommand("bench-render", "measures drawing; footwall bench render starts it")) {
  render_->add_option("JOB", job_, "what to draw, JSON")->required();
  bench_->add_option("JOB", job_, "what to measure, JSON")->required();
}

void RenderCommand::run(const comm::Communicator& world) const {
  if (render_->parsed()) {
    session::run_render(world, job_, running_job(world));
  } else {
    session::run_render_bench(world, job_, running_job(world));
  }
}

}  // namespace footwall::app
