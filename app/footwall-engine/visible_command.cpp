#include "app/footwall-engine/visible_command.h"

#include "app/footwall-engine/running_job.h"
#include "engine/tasks/visible_bench/visible_bench.h"

namespace footwall::app {

VisibleCommand::VisibleCommand(CLI::App& app)
    : bench_(app.add_subcommand("bench-visible",
                                "measures passes over what can be seen; footwall bench visible starts it")) {
  bench_->add_option("JOB", job_, "what to measure, JSON")->required();
}

void VisibleCommand::run(const comm::Communicator& world) const {
  tasks::run_visible_bench(world, job_, running_job(world));
}

}  // namespace footwall::app
