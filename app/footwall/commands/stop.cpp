// footwall stop: ends a running engine.
#include <chrono>
#include <memory>
#include <thread>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/running.h"
#include "engine/service/client/engine_client.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string engine;
};

constexpr std::chrono::seconds kPatience{20};
constexpr std::chrono::milliseconds kPause{20};

// Calls under way are cancelled, which takes them a moment.
void wait_until_gone(const service::Connection& connection, const JobContext& job) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    job.check();
    try {
      service::EngineClient(connection).status();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kEngine) return;
      throw;
    }
    if (std::chrono::steady_clock::now() > end) {
      throw Error(ErrorCode::kEngine, "the engine was told to stop and goes on",
                  "end its footwall serve with Ctrl+C");
    }
    std::this_thread::sleep_for(kPause);
  }
}

console::Output run(const Options& options, const JobContext& job) {
  const service::Connection connection = running_engine(options.engine);
  service::EngineClient(connection).shutdown();
  wait_until_gone(connection, job);
  return {{{"stopped", connection.address}}, "stopped the engine at " + connection.address};
}

}  // namespace

void add_stop(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "stop", "End a running engine; what it computes is cancelled",
                  [options](console::Console& console) { return run(*options, console.job()); });
  command->add_option(
      "engine", options->engine,
      "A project that is served, @FILE or an address (default: the engine without a project)");
}

}  // namespace footwall::commands
