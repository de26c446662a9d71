// Who may call, and how often the others may try.
#pragma once
#include <array>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace footwall::service {

class Token {
 public:
  // Throws Error kUsage for fewer than 32 characters.
  explicit Token(const std::string& token);
  // In a time that does not depend on what is offered, but for its length.
  bool is(std::string_view offered) const;

 private:
  using Digest = std::array<unsigned char, 32>;
  static Digest digest_of(std::string_view text);
  Digest digest_;
};

// How many failures are answered at once: `burst`, and `rate` more each second.
class FailureRate {
 public:
  using Clock = std::chrono::steady_clock;
  FailureRate(double burst, double rate) : burst_(burst), rate_(rate), left_(burst) {}
  // Whether one more may be answered now. From any thread.
  bool allows(Clock::time_point now = Clock::now());

 private:
  const double burst_;
  const double rate_;
  std::mutex mutex_;
  double left_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace footwall::service
