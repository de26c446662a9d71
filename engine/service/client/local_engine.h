// An engine of this machine that a program starts for itself: started when first needed, started again when
// it died. What the engine held is there again then: the project is replayed, and the edits that the project
// does not have yet.
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

// Safe to use from several threads; a client from one at a time.
class LocalEngine {
 public:
  // What brings a fresh engine to where the program is: opens volumes, replaces faults, from the project.
  // Called after every start.
  using Replay = std::function<void(EngineClient&)>;

  // Starts nothing yet.
  LocalEngine(session::LaunchOptions options, Replay replay);
  // Ends the engine: no process, socket or shared-memory file stays. Its streams must be gone.
  ~LocalEngine();
  LocalEngine(const LocalEngine&) = delete;
  LocalEngine& operator=(const LocalEngine&) = delete;

  // The client of a running engine, which is started, and the replay done, where there is none. Throws
  // kEngine where it cannot be started, or died three times within a minute, saying what its last words were.
  std::shared_ptr<EngineClient> client(const JobContext& job = {});
  // f with a client; where the engine died or hung on the way, once more with a new one.
  void with_engine(const std::function<void(EngineClient&)>& f, const JobContext& job = {});

  // Edits that outlive the engine: what it has taken is told to each fresh one, after the replay. Numbers are
  // the program's (0: one more than its newest), and may differ from those that the engine has them under.
  v1::EditModelReply edit(const v1::EditBatch& batch, const JobContext& job = {});
  // The same as a stream (EngineClient::live()). Where the engine dies, edits that were not answered are
  // answered by the next one. Throws from send() and finish() only what is no death, and what client()
  // throws.
  std::unique_ptr<EngineClient::LiveStream> live(const std::string& volume, const v1::ExtractOptions& options,
                                                 std::function<void(const v1::LiveReply&)> answer);
  // The replay knows them by now.
  void forget_edits();

  bool is_running() const;
  // How to reach the engine that runs, for a second client. Throws kEngine where none does.
  Connection connection() const;
  int starts() const;

 private:
  class Steady;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
