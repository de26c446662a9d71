// How much of a known number of bytes is done, and how fast it goes: the amounts of a progress report.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace footwall {

class ByteRate {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ByteRate(std::int64_t total, Clock::time_point start = Clock::now())
      : total_(total), start_(start), marked_at_(start) {}

  // "480 of 1074 MB  830 MB/s"; MB = 10^6 bytes. The rate is that of the last seconds, so that it shows a
  // disk that has become slow, and at the end that of the whole; left out where no time has passed.
  std::string text(std::int64_t done, Clock::time_point now);

 private:
  std::int64_t total_;
  Clock::time_point start_;
  Clock::time_point marked_at_;  // where the window that is being measured began
  std::int64_t marked_ = 0;
  std::optional<double> window_rate_;  // MB/s of the last whole window
};

}  // namespace footwall
