// A client's call on its way from the thread that received it to the ranks and back. No RPC and no MPI in
// here: the server makes calls, tests make calls of their own.
//
// Threads: the receiving thread makes it and pushes it onto the CallQueue; the dispatcher, rank 0's main
// thread, takes its command, sends replies and finishes it. cancel() may come from any thread.
#pragma once
#include <google/protobuf/message.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::v1 {
class Command;
}

namespace footwall::service {

class Call {
 public:
  using Clock = std::chrono::steady_clock;

  // what: the method's name, for `Status`.
  explicit Call(std::string what);
  virtual ~Call() = default;
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  // What the ranks are to do now. Asked by the dispatcher when the call's turn has come: a call that gathers
  // edits gives all that it has. Called once per push.
  virtual v1::Command take_command() = 0;
  // One message of the answer, of the method's reply type. Blocks while the client is slower than the engine,
  // up to a time that the server sets; throws Error kCancelled once the client has gone or was too slow.
  virtual void send(const google::protobuf::Message& reply) = 0;
  // The command's end: success, or why not. Once for each push, from the dispatcher's thread; for a call that
  // is cancelled while it waits, or whose queue is closed, from the thread that does so. Never throws.
  virtual void finish(const std::optional<Error>& failure) noexcept = 0;

  const std::string& what() const { return what_; }
  std::uint64_t id() const { return id_; }  // given by the queue; 0 before
  // Cancelled by the client's leaving, by Cancel, or by the engine's end. Its progress is kept for `Status`,
  // and handed to progressed().
  const JobContext& context() const { return context_; }
  struct State {
    bool running = false;
    double fraction = 0;
    std::string phase;
    std::string amounts;
    Clock::time_point since;  // began, or was pushed
  };
  State state() const;

 protected:
  // On the dispatcher's thread, at most ten times a second and for every new phase.
  virtual void progressed(const State& state);

 private:
  friend class CallQueue;
  std::string what_;
  std::uint64_t id_ = 0;
  mutable std::mutex mutex_;
  State state_;
  JobContext context_;
};

}  // namespace footwall::service
