#include "bench/service/bench_calls.h"

#include <fmt/format.h>

#include <algorithm>

namespace footwall::service {

void TimedCall::send(const google::protobuf::Message& reply) {
  if (on_reply) on_reply(reply);
}

void TimedCall::finish(const std::optional<Error>& failure) noexcept {
  const std::scoped_lock lock(mutex_);
  over_ = Clock::now();
  failure_ = failure;
  finished_ = true;
  changed_.notify_all();
}

double TimedCall::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return finished_; });
  if (failure_) throw Error(*failure_);
  return std::chrono::duration<double>(over_ - begun_).count();
}

bool TimedCall::wait_until_over() {
  try {
    wait();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kCancelled) throw;
    return true;
  }
  return false;
}

double timed(CallQueue& queue, const v1::Command& command,
             const std::function<void(const google::protobuf::Message&)>& on_reply) {
  const auto call = std::make_shared<TimedCall>(command);
  call->on_reply = on_reply;
  queue.push(call);
  return call->wait();
}

std::string spread(std::vector<double> seconds) {
  if (seconds.empty()) return "never";
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e3 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  return fmt::format("median {:.3f} ms, p99 {:.3f} ms, most {:.3f} ms ({} times)", at(0.5), at(0.99), at(1),
                     seconds.size());
}

}  // namespace footwall::service
