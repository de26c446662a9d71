#include "engine/service/queue/call_queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace footwall::service {

CallQueue::CallQueue(std::size_t most) : most_(most) {}

namespace {

const Error& cancelled() {
  static const Error kCancelled(ErrorCode::kCancelled, "cancelled", "nothing was changed");
  return kCancelled;
}

}  // namespace

CallQueue::Calls CallQueue::take_cancelled() {
  Calls gone;
  for (Calls* calls : {&waiting_, &reads_}) {
    const auto is_left = [](const std::shared_ptr<Call>& call) { return !call->context().cancelled(); };
    const auto at = std::stable_partition(calls->begin(), calls->end(), is_left);
    gone.insert(gone.end(), std::make_move_iterator(at), std::make_move_iterator(calls->end()));
    calls->erase(at, calls->end());
  }
  return gone;
}

void CallQueue::add(std::shared_ptr<Call> call, Calls& to) {
  // Finished when the lock is gone: a call may ask the queue.
  struct Finish {
    Calls calls;
    ~Finish() {
      for (const auto& each : calls) each->finish(cancelled());
    }
  } gone;
  {
    const std::scoped_lock lock(mutex_);
    if (closed_) throw Error(*closed_);
    if (waiting_.size() + reads_.size() >= most_) gone.calls = take_cancelled();
    if (waiting_.size() + reads_.size() >= most_) {
      throw Error(ErrorCode::kMemory, fmt::format("{} calls wait for the engine already", most_),
                  "wait for some of them, or cancel them");
    }
    if (call->id_ == 0) call->id_ = ++last_id_;
    {
      const std::scoped_lock state_lock(call->mutex_);
      call->state_.running = false;
      call->state_.since = Call::Clock::now();
    }
    to.push_back(std::move(call));
  }
  changed_.notify_one();
}

void CallQueue::push(std::shared_ptr<Call> call) {
  add(std::move(call), waiting_);
}

void CallQueue::push_read(std::shared_ptr<Call> call) {
  add(std::move(call), reads_);
}

std::shared_ptr<Call> CallQueue::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !waiting_.empty() || !reads_.empty(); });
  Calls& from = reads_.empty() ? waiting_ : reads_;
  if (from.empty()) return nullptr;
  running_ = std::move(from.front());
  from.pop_front();
  const std::scoped_lock state_lock(running_->mutex_);
  running_->state_.running = true;
  running_->state_.since = Call::Clock::now();
  return running_;
}

std::shared_ptr<Call> CallQueue::next_read() {
  const std::scoped_lock lock(mutex_);
  if (reads_.empty()) return nullptr;
  std::shared_ptr<Call> read = std::move(reads_.front());
  reads_.pop_front();
  return read;
}

void CallQueue::done() {
  const std::scoped_lock lock(mutex_);
  running_.reset();
}

std::vector<CallQueue::Entry> CallQueue::entries() const {
  const std::scoped_lock lock(mutex_);
  std::vector<Entry> all;
  const auto add_entry = [&](const Call& call) { all.push_back({call.id(), call.what(), call.state()}); };
  if (running_) add_entry(*running_);
  for (const auto& call : reads_) add_entry(*call);
  for (const auto& call : waiting_) add_entry(*call);
  return all;
}

bool CallQueue::cancel(std::uint64_t id) {
  Calls gone;
  {
    const std::scoped_lock lock(mutex_);
    const auto is_it = [&](const std::shared_ptr<Call>& call) { return call && call->id() == id; };
    if (is_it(running_)) {
      running_->context().cancel();
      return true;
    }
    for (Calls* calls : {&waiting_, &reads_}) {
      const auto at = std::find_if(calls->begin(), calls->end(), is_it);
      if (at == calls->end()) continue;
      (*at)->context().cancel();
      gone.push_back(std::move(*at));
      calls->erase(at);
      break;
    }
  }
  // One that waits need not wait for its turn to be told.
  for (const auto& call : gone) call->finish(cancelled());
  return !gone.empty();
}

void CallQueue::close(const Error& why) {
  Calls left;
  {
    const std::scoped_lock lock(mutex_);
    if (!closed_) closed_ = why;
    left.swap(waiting_);
    left.insert(left.end(), reads_.begin(), reads_.end());
    reads_.clear();
    if (running_) running_->context().cancel();
  }
  changed_.notify_all();
  for (const auto& call : left) call->finish(why);
}

}  // namespace footwall::service
