// An engine of this machine that a program starts for itself: started when first needed, started again when
// it died.
#pragma once
#include <chrono>
#include <deque>
#include <functional>
#include <memory>

#include "engine/service/client/engine_client.h"
#include "engine/session/launch.h"

namespace footwall::service {

// How often an engine died lately: who starts it again wants to know when that leads nowhere.
class DeathCount {
 public:
  // One more; false where it was the third within a minute.
  bool add();

 private:
  std::deque<std::chrono::steady_clock::time_point> deaths_;
};

class LocalEngine {
 public:
  // What brings a fresh engine to where the program is: opens volumes, replaces faults, from the project.
  // Called after every start.
  using Replay = std::function<void(EngineClient&)>;

  // Starts nothing yet.
  LocalEngine(session::LaunchOptions options, Replay replay);
  // Ends the engine: no process, socket or shared-memory file stays.
  ~LocalEngine();
  LocalEngine(const LocalEngine&) = delete;
  LocalEngine& operator=(const LocalEngine&) = delete;

  // The client of a running engine, which is started, and the replay done, where there is none. Throws
  // kEngine where it cannot be started, or died three times within a minute, saying what its last words were.
  EngineClient& client(const JobContext& job = {});
  // f with a client; where the engine died on the way, once more with a new one.
  void with_engine(const std::function<void(EngineClient&)>& f, const JobContext& job = {});
  bool is_running() const;
  // How to reach the engine that runs, for a second client. Throws kEngine where none does.
  Connection connection() const;
  int starts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
