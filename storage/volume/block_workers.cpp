#include "storage/volume/block_workers.h"

#include "storage/base/error.h"

namespace footwall::volume {

BlockWorkers::BlockWorkers(std::size_t threads, std::size_t slots, Work work)
    : work_(std::move(work)), slots_(slots) {
  require(threads > 0 && slots > 0, "at least one thread and one slot");
  for (std::size_t slot = slots; slot-- > 0;) free_.push_back(slot);
  try {
    for (std::size_t worker = 0; worker < threads; ++worker) {
      threads_.emplace_back([this, worker] { run(worker); });
    }
  } catch (const std::system_error&) {
    // Fewer threads than hoped for do the same work; none at all is an error.
    if (threads_.empty()) throw Error(ErrorCode::kMemory, "no thread can be started");
  }
}

BlockWorkers::~BlockWorkers() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    waiting_.clear();
  }
  changed_for_workers_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void BlockWorkers::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

std::size_t BlockWorkers::take_free() {
  std::unique_lock lock(mutex_);
  changed_for_producer_.wait(lock, [this] { return !free_.empty() || failure_; });
  rethrow();
  const std::size_t slot = free_.back();
  free_.pop_back();
  return slot;
}

void BlockWorkers::submit(std::size_t slot) {
  {
    const std::scoped_lock lock(mutex_);
    rethrow();
    waiting_.push_back(slot);
  }
  changed_for_workers_.notify_one();
}

void BlockWorkers::finish() {
  std::unique_lock lock(mutex_);
  changed_for_producer_.wait(lock, [this] { return free_.size() == slots_ || failure_; });
  rethrow();
}

void BlockWorkers::run(std::size_t worker) {
  for (;;) {
    std::size_t slot = 0;
    {
      std::unique_lock lock(mutex_);
      changed_for_workers_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      slot = waiting_.front();
      waiting_.pop_front();
    }
    std::exception_ptr failure;
    try {
      work_(slot, worker);
    } catch (...) {
      failure = std::current_exception();
    }
    {
      const std::scoped_lock lock(mutex_);
      free_.push_back(slot);
      if (failure && !failure_) failure_ = failure;
    }
    changed_for_producer_.notify_one();
  }
}

}  // namespace footwall::volume
