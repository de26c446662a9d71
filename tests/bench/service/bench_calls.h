// Calls that are timed, from their push to their end.
#pragma once
#include <condition_variable>
#include <functional>
#include <string>
#include <vector>

#include "engine/service/queue/call_queue.h"
#include "engine/service/ranks.pb.h"

namespace footwall::service {

class TimedCall : public Call {
 public:
  explicit TimedCall(v1::Command command) : Call("Bench"), command_(std::move(command)) {}
  v1::Command take_command() override { return command_; }
  void send(const google::protobuf::Message& reply) override;
  void finish(const std::optional<Error>& failure) noexcept override;
  // Seconds since it was made; throws its error.
  double wait();
  // The same, but for kCancelled: whether it was.
  bool wait_until_over();

  std::function<void(const google::protobuf::Message&)> on_reply;

 private:
  v1::Command command_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point over_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Error> failure_;
  bool finished_ = false;
};

// Seconds of one command.
double timed(CallQueue& queue, const v1::Command& command,
             const std::function<void(const google::protobuf::Message&)>& on_reply = {});

// "median 0.12 ms, p99 0.31 ms, most 0.8 ms (10000 times)"
std::string spread(std::vector<double> seconds);

}  // namespace footwall::service
