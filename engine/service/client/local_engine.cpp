#include "engine/service/client/local_engine.h"

#include <chrono>
#include <deque>
#include <optional>

#include "engine/service/client/engine_process.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostDeaths = 3;
constexpr std::chrono::minutes kDeathsCount{1};
// A client sees a broken connection before the launcher has seen its ranks' end.
constexpr std::chrono::seconds kTimeToDie{5};

}  // namespace

bool DeathCount::add() {
  const auto now = Clock::now();
  while (!deaths_.empty() && now - deaths_.front() > kDeathsCount) deaths_.pop_front();
  deaths_.push_back(now);
  return deaths_.size() < kMostDeaths;
}

struct LocalEngine::State {
  session::LaunchOptions options;
  Replay replay;
  std::unique_ptr<EngineProcess> process;
  std::unique_ptr<EngineClient> client;  // null until the replay was done
  Connection connection;
  DeathCount deaths;
  int starts = 0;

  bool runs() const { return process && !process->wait_for_end(std::chrono::milliseconds(0)); }

  // What ends an attempt to go on with this engine: counts it, and throws where it was one too many.
  void bury() {
    client.reset();
    if (!process) return;
    process->stop();
    const std::string words = process->last_words();
    process.reset();
    if (deaths.add()) return;
    throw Error(ErrorCode::kEngine, "the engine died three times within a minute",
                "its last words: it " + words);
  }

  void start(const JobContext& job) {
    ++starts;
    EngineProcessOptions how;
    how.launch = options;
    process = std::make_unique<EngineProcess>(how);
    std::optional<Connection> reached;
    try {
      reached = process->wait_until_ready(job);
    } catch (...) {
      process.reset();  // it cannot be started here, and so not a second time
      throw;
    }
    auto fresh = std::make_unique<EngineClient>(*reached);
    connection = *reached;
    if (replay) replay(*fresh);
    client = std::move(fresh);
  }

  // Whether an error of a call comes from the engine's end.
  bool died(const Error& error) {
    if (error.code() != ErrorCode::kEngine) return false;
    if (!process || process->wait_for_end(kTimeToDie)) return true;
    try {
      if (client) client->status();
      return !client;
    } catch (const Error&) {
      return true;
    }
  }
};

LocalEngine::LocalEngine(session::LaunchOptions options, Replay replay) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  state_->replay = std::move(replay);
}

LocalEngine::~LocalEngine() = default;

EngineClient& LocalEngine::client(const JobContext& job) {
  for (;;) {
    job.check();
    if (state_->client && state_->runs()) return *state_->client;
    state_->bury();
    try {
      state_->start(job);
    } catch (const Error& error) {
      if (!state_->process) throw;
      if (state_->died(error)) continue;  // in the middle of the replay
      state_->process.reset();
      throw;
    }
  }
}

void LocalEngine::with_engine(const std::function<void(EngineClient&)>& f, const JobContext& job) {
  EngineClient& first = client(job);
  try {
    f(first);
    return;
  } catch (const Error& error) {
    if (!state_->died(error)) throw;
  }
  state_->bury();
  f(client(job));
}

bool LocalEngine::is_running() const {
  return state_->runs();
}

Connection LocalEngine::connection() const {
  if (!state_->client) throw Error(ErrorCode::kEngine, "no engine runs");
  return state_->connection;
}

int LocalEngine::starts() const {
  return state_->starts;
}

}  // namespace footwall::service
