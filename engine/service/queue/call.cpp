#include "engine/service/queue/call.h"

namespace footwall::service {

Call::Call(std::string what)
    : what_(std::move(what)), context_([this, last = Clock::time_point()](const Progress& progress) mutable {
        constexpr std::chrono::milliseconds kPause(100);
        State now;
        {
          const std::scoped_lock lock(mutex_);
          const bool is_new_phase = state_.phase != progress.phase;
          state_.fraction = progress.fraction;
          state_.phase = progress.phase;
          state_.amounts = progress.amounts;
          const auto time = Clock::now();
          if (!is_new_phase && time < last + kPause) return;
          last = time;
          now = state_;
        }
        progressed(now);
      }) {}

Call::State Call::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

void Call::progressed(const State& /*state*/) {}

}  // namespace footwall::service
