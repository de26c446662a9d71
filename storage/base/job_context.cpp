#include "storage/base/job_context.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall {

struct JobContext::State {
  Listener listener;
  std::atomic<bool> cancelled{false};
  double reached = 0;
};

JobContext::JobContext() : state_(std::make_shared<State>()) {}

JobContext::JobContext(Listener listener) : state_(std::make_shared<State>()) {
  state_->listener = std::move(listener);
}

JobContext JobContext::part(double from, double to) const {
  JobContext part = *this;
  part.from_ = from_ + (to_ - from_) * from;
  part.to_ = from_ + (to_ - from_) * to;
  return part;
}

void JobContext::report(double fraction, std::string_view phase, std::string amounts) const {
  if (state_->listener) {
    const double whole = from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0);
    state_->reached = std::max(state_->reached, whole);
    state_->listener({state_->reached, phase, std::move(amounts)});
  }
  check();
}

void JobContext::check() const {
  if (cancelled()) throw Error(ErrorCode::kCancelled, "cancelled", "nothing was changed");
}

bool JobContext::cancelled() const noexcept {
  return state_->cancelled.load(std::memory_order_relaxed);
}

void JobContext::cancel() const noexcept {
  state_->cancelled.store(true, std::memory_order_relaxed);
}

}  // namespace footwall
