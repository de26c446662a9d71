#include "app/footwall-engine/workload_command.h"

#include "app/footwall-engine/running_job.h"
#include "storage/base/text.h"

namespace footwall::app {
namespace {

std::array<int, 2> pillars_from(const std::string& text) {
  const auto parts = text::split(text, 'x');
  const auto a = parts.size() == 2 ? text::integer(parts[0]) : std::nullopt;
  const auto b = parts.size() == 2 ? text::integer(parts[1]) : std::nullopt;
  constexpr std::int64_t kMost = 1 << 20;
  if (!a || !b || *a < 1 || *b < 1 || *a > kMost || *b > kMost) {
    throw Error(ErrorCode::kUsage, "--interleave " + text + " is not a number of pillars",
                "give pillars along inlines x along crosslines, as 2x2");
  }
  return {static_cast<int>(*a), static_cast<int>(*b)};
}

}  // namespace

WorkloadCommand::WorkloadCommand(CLI::App& app)
    : command_(app.add_subcommand("workload", "runs a scripted workload; footwall workload run starts it")) {
  extract::Options& options = run_.options;
  command_->add_option("SCRIPT", run_.script, "the workload")->required();
  command_->add_option("--result", run_.result, "where the result is written, JSON")->required();
  command_->add_option("--exchange", options.exchange);
  command_->add_option("--balance", options.balance);
  command_->add_option("--voxelizer", options.voxelizer);
  command_->add_option("--compute", compute_, "comma separated");
  command_->add_option("--threads", options.threads, "of each rank");
  command_->add_option("--interleave", interleave_, "pillars of each rank, AxB");
  command_->add_option("--memory", options.cache_bytes, "bytes of a rank's cached voxels");
  command_->add_option("--snr", options.snr, "dB");
  command_->add_option("--seed", run_.seed, "of the voxels");
  command_->add_flag("--keep-cache", run_.keep_cache);
  command_->add_flag("--phases-apart", options.phases_apart);
}

void WorkloadCommand::run(const comm::Communicator& world) {
  world.collectively([&] {
    run_.options.pillars = pillars_from(interleave_);
    for (const std::string_view name : text::split(compute_, ',')) {
      if (!name.empty()) run_.options.compute.emplace_back(name);
    }
  });
  tasks::run_workload(world, run_, running_job(world));
}

}  // namespace footwall::app
