// footwall batch: runs a job that extract --write-job wrote, here.
#include <fmt/format.h>
#include <csignal>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "engine/session/batch.h"
#include "engine/session/job.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string job, volume;
  EngineOptions engine;
};

volatile std::sig_atomic_t g_terminated = 0;  // NOLINT(readability-identifier-naming)
void (*g_cancel)(int) = nullptr;              // NOLINT(readability-identifier-naming)

extern "C" void terminate_and_cancel(int number) {
  g_terminated = 1;
  g_cancel(number);
}

// SIGTERM and SIGUSR1 are how batch systems ask for their processors: the same as Ctrl+C, but with another
// exit status.
void notice_termination() {
  struct sigaction action = {};
  ::sigaction(SIGTERM, nullptr, &action);
  g_cancel = action.sa_handler;
  action.sa_handler = terminate_and_cancel;
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGUSR1, &action, nullptr);
}

console::Output run(const Options& options, const console::Console& console) {
  notice_termination();
  session::LaunchOptions launch = options.engine.launch();
  launch.volume = options.volume;
  // The threads that the job was written for, unless other ones are asked for.
  if (launch.threads == 0) launch.threads = session::read_job(options.job).options.threads;
  try {
    const console::Json result =
        console::Json::parse(session::run_engine(launch, options.job, console.job()));
    console::Output output;
    add_result(result, output.json);
    output.json["parts"] = result.at("parts");
    output.text = result_in_words(result) + "\n";
    return output;
  } catch (const Error& error) {
    const bool preempted = dynamic_cast<const session::Preempted*>(&error) != nullptr;
    if (!preempted && !(error.code() == ErrorCode::kCancelled && g_terminated != 0)) throw;
    const Error resumable(ErrorCode::kCancelled, "the job was told to make room",
                          "run it again: it goes on with the faults that are not done");
    std::fprintf(stderr, "footwall: %s\n", resumable.what());
    return {console::error_json(resumable), "", session::kResumable};
  }
}

}  // namespace

void add_batch(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "batch", "Run a job that was written into a folder",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("job", options->job, "The job's JOB.json")->required();
  command->add_option("--volume", options->volume, "Where the volume is here (default: where the job says)");
  options->engine.add_to(*command, true);
}

}  // namespace footwall::commands
