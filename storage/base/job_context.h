// Progress and cancel for everything that takes longer than 50 ms. Copies share one cancel flag and one
// listener, so a task hands a part of its progress bar to what it calls: step(job.part(0.2, 0.6)).
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace footwall {

struct Progress {
  double fraction = 0;     // 0 to 1 of the whole job, never falling
  std::string_view phase;  // what is being done, e.g. "read"
  std::string amounts;     // how many of how many, with units; may be empty
};

class JobContext {
 public:
  using Listener = std::function<void(const Progress&)>;

  // A job that nobody listens to and nobody cancels.
  JobContext();
  // listener is called from the thread that reports.
  explicit JobContext(Listener listener);

  // The part of this job from fraction `from` to `to`; cancelled with it.
  JobContext part(double from, double to) const;

  // Tells the listener, then throws Error kCancelled if the job was cancelled.
  void report(double fraction, std::string_view phase, std::string amounts = {}) const;
  // Throws Error kCancelled if the job was cancelled; cheap enough for inner loops.
  void check() const;
  bool cancelled() const noexcept;
  // May be called from any thread and from a signal handler.
  void cancel() const noexcept;

 private:
  struct State;
  std::shared_ptr<State> state_;
  double from_ = 0;
  double to_ = 1;
};

}  // namespace footwall
