// Adds the time of its own life to a number, and the processor's time of the whole process to another where
// that is wanted too: for reports of where a computation's time goes. Seconds.
#pragma once
#include <time.h>

#include <chrono>

namespace footwall {

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(double& seconds, double& busy)
      : seconds_(seconds), busy_(&busy), start_busy_(processor_seconds()) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (busy_ != nullptr) *busy_ += processor_seconds() - start_busy_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  // Of all threads.
  static double processor_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
  }

  double& seconds_;
  double* busy_ = nullptr;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double start_busy_ = 0;
};

}  // namespace footwall
