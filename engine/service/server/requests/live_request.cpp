#include "engine/service/server/requests/live_request.h"

namespace footwall::service {
namespace {

// Of edits that wait: beyond it the client is not read until the ranks took them.
constexpr std::int64_t kMostGathered = std::int64_t{64} << 20;

}  // namespace

void LiveRequest::received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) {
  v1::LiveRequest message;
  const std::int64_t memory = unpack(bytes, size, message);
  if (!message.has_batch()) give_back(memory);
  bool pause = false;
  {
    const std::scoped_lock lock(mutex_);
    take(message, memory);
    pause = reading_paused_ = gathered_bytes_ > kMostGathered;
  }
  wait_for_turn();
  if (!pause) reply_->read_on();
}

void LiveRequest::take(v1::LiveRequest& message, std::int64_t memory) {
  if (!begun_) {
    if (message.volume().empty())
      throw Error(ErrorCode::kInvalid, "the first message of Live names no volume",
                  "it says from which volume and which numbers");
    gathered_.set_volume(message.volume());
    *gathered_.mutable_options() = message.options();
    begun_ = true;
  } else if (!message.volume().empty() || message.has_options()) {
    throw Error(ErrorCode::kInvalid, "a later message of Live names a volume or options",
                "only the first can; open another stream for another volume");
  }
  if (!message.has_batch()) return;
  if (gathered_.batches().empty()) oldest_ = Clock::now();
  gathered_.add_batches()->Swap(message.mutable_batch());
  gathered_bytes_ += memory;
}

void LiveRequest::wait_for_turn() {
  {
    const std::scoped_lock lock(mutex_);
    if (turn_ != Turn::kIdle || gathered_.batches().empty()) return;
    turn_ = Turn::kInQueue;
  }
  services_->queue.push(shared_from_this());
}

void LiveRequest::no_more() {
  bool over = false;
  {
    const std::scoped_lock lock(mutex_);
    all_said_ = true;
    over = turn_ == Turn::kIdle;
  }
  if (over) reply_->end(std::nullopt);
}

void LiveRequest::left() noexcept {
  {
    const std::scoped_lock lock(mutex_);
    gathered_.clear_batches();
    gathered_bytes_ = 0;
  }
  RankCall::left();
}

v1::Command LiveRequest::take_command() {
  v1::Command command;
  command.set_job(id());
  v1::LiveStep& step = *command.mutable_live();
  bool read = false;
  {
    const std::scoped_lock lock(mutex_);
    step.set_volume(gathered_.volume());
    *step.mutable_options() = gathered_.options();
    step.mutable_batches()->Swap(gathered_.mutable_batches());
    step.set_waited_seconds(std::chrono::duration<double>(Clock::now() - oldest_).count());
    gathered_bytes_ = 0;
    read = std::exchange(reading_paused_, false);
  }
  forget();
  if (read) reply_->read_on();
  return command;
}

void LiveRequest::finish(const std::optional<Error>& failure) noexcept {
  if (failure) {
    forget();
    reply_->end(failure);
    return;
  }
  bool over = false;
  {
    const std::scoped_lock lock(mutex_);
    turn_ = Turn::kIdle;
    over = all_said_ && gathered_.batches().empty();
  }
  if (over) {
    reply_->end(std::nullopt);
    return;
  }
  try {
    wait_for_turn();
  } catch (const Error& error) {
    reply_->end(error);
  }
}

}  // namespace footwall::service
