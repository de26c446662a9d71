// The calls that wait for the ranks, first come, first served; the one that runs; and the box reads that may
// slip in between its slices.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/service/queue/call.h"

namespace footwall::service {

class CallQueue {
 public:
  // most: waiting calls, beyond which push() refuses.
  explicit CallQueue(std::size_t most = 256);

  // From any thread. Throws Error kEngine where the queue is closed (the engine ends), kMemory where too many
  // wait. A call may be pushed again after its command was finished (Live).
  void push(std::shared_ptr<Call> call);
  // The same for reads that no other rank takes part in.
  void push_read(std::shared_ptr<Call> call);

  // The dispatcher: waits for a call, and makes it the running one; null when the queue was closed and is
  // empty.
  std::shared_ptr<Call> next();
  // The dispatcher, between slices of the running call: a waiting read, or null.
  std::shared_ptr<Call> next_read();
  // The running call is done with.
  void done();

  // Calls that wait or run.
  struct Entry {
    std::uint64_t id;
    std::string what;
    Call::State state;
  };
  std::vector<Entry> entries() const;
  // Cancels a call, waiting or running; false where there is none of that id. One that waits is finished at
  // once, on this thread; one whose own context was cancelled (its client has left) when its turn comes, or
  // when its place is needed.
  bool cancel(std::uint64_t id);
  // No more calls are taken; those that wait are failed with `why`, the running one is cancelled.
  void close(const Error& why);

 private:
  using Calls = std::deque<std::shared_ptr<Call>>;
  void add(std::shared_ptr<Call> call, Calls& to);
  Calls take_cancelled();  // those that wait

  std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Calls waiting_;
  Calls reads_;
  std::shared_ptr<Call> running_;
  std::uint64_t last_id_ = 0;
  std::optional<Error> closed_;
};

}  // namespace footwall::service
