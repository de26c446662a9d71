// The processes of a resident engine that this program has started: keeper, launcher and ranks. They end with
// it, whatever ends it, and leave nothing (session/keeper.h).
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/service/client/connection_file.h"
#include "engine/session/keeper.h"
#include "engine/session/launch.h"
#include "storage/base/job_context.h"

namespace footwall::service {

struct EngineProcessOptions {
  session::LaunchOptions launch;
  std::string listen = "unix";    // a socket in the engine's private folder; "unix:PATH", "tcp:HOST:PORT"
  std::string token;              // empty: a random one, for this process alone
  std::filesystem::path volumes;  // a folder whose volumes are found by checksum; empty: none
  // Where key and certificate for "tcp:" stay, on the machine of rank 0; empty: new ones at each start.
  std::filesystem::path certificates;
  std::int64_t memory_bytes = 0;  // of each host; 0: what is free there
  std::string project;            // for the connection
  // What goes with this program, should it be killed: beside what the engine itself leaves.
  session::Belongings belongings;
};

// 64 hexadecimal digits that nobody can guess.
std::string random_token();

class EngineProcess {
 public:
  // Starts it; the token goes through its environment. Throws Error kEngine, kIo; kUsage for a socket's path
  // that the system does not take.
  explicit EngineProcess(EngineProcessOptions options);
  // Ends it as stop() does.
  ~EngineProcess();
  EngineProcess(const EngineProcess&) = delete;
  EngineProcess& operator=(const EngineProcess&) = delete;

  // Waits until it serves. Throws the Error that it ended with, kCancelled, kEngine with its last words where
  // it ended otherwise or says nothing for two minutes.
  Connection wait_until_ready(const JobContext& job);
  // Waits for its end, so long at most; whether it has ended.
  bool wait_for_end(std::chrono::milliseconds most) const;
  // Whether it ended because it was told to. False while it runs.
  bool ended_well() const;
  // How it ended and what it said last: "was killed by signal 9 (Killed): ..."
  std::string last_words() const;
  // Asks it to end, as a client does; after five seconds its launcher, and after five more it is killed.
  // Nothing of it is left then.
  void stop();
  // The same without asking: of one that is dead or hangs.
  void kill();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
