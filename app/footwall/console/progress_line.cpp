#include "app/footwall/console/progress_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace footwall::console {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kLineEvery = 0.05;
constexpr seconds kLineAfter{30};
constexpr milliseconds kBarEvery{100};
constexpr int kBarCells = 24;
constexpr seconds kPaceOver{5};
constexpr double kLongest = 30 * 86400.0;  // seconds; what a stalled job would say helps nobody

}  // namespace

std::string spoken(std::chrono::seconds duration) {
  const auto total = duration.count();
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} h {:02} min", total / 3600, total % 3600 / 60);
}

ProgressLine::ProgressLine(bool terminal, int columns, Clock::time_point start)
    : terminal_(terminal), columns_(columns), shown_at_(start), older_{start}, newer_{start} {}

std::string ProgressLine::time_left(const Progress& progress, Clock::time_point now) {
  if (now - newer_.at >= kPaceOver) {
    older_ = newer_;
    newer_ = {now, progress.fraction};
  }
  const double spent = std::chrono::duration<double>(now - older_.at).count();
  const double gained = progress.fraction - older_.fraction;
  if (progress.fraction < 0.02 || progress.fraction >= 1 || spent < 1 || gained <= 0) return {};
  const double left = spent * (1 - progress.fraction) / gained;
  if (left < 1 || left > kLongest) return {};
  return "  " + spoken(seconds(static_cast<long>(left + 0.5))) + " left";
}

std::string ProgressLine::update(const Progress& progress, Clock::time_point now) {
  const std::string left = time_left(progress, now);
  const bool new_phase = progress.phase != shown_phase_;
  const bool finished = progress.fraction >= 1 && shown_ < 1;
  const bool due = terminal_ ? now - shown_at_ >= kBarEvery
                             : progress.fraction - shown_ >= kLineEvery || now - shown_at_ >= kLineAfter;
  if (shown_ >= 0 && !due && !finished && !(terminal_ && new_phase)) return {};
  shown_ = progress.fraction;
  shown_at_ = now;
  shown_phase_ = progress.phase;

  std::string tail;
  if (!progress.amounts.empty()) tail += "  " + progress.amounts;
  tail += left;
  if (!terminal_) return fmt::format("{:3.0f} %  {}{}\n", progress.fraction * 100, progress.phase, tail);

  const int filled = std::clamp(static_cast<int>(progress.fraction * kBarCells), 0, kBarCells);
  std::string line = fmt::format("[{}{}] {:3.0f} %  {}{}", std::string(static_cast<std::size_t>(filled), '='),
                                 std::string(static_cast<std::size_t>(kBarCells - filled), ' '),
                                 progress.fraction * 100, progress.phase, tail);
  if (static_cast<int>(line.size()) >= columns_)
    line.resize(static_cast<std::size_t>(std::max(columns_ - 1, 0)));
  return "\r\x1b[2K" + line;
}

std::string ProgressLine::end() const {
  return terminal_ && shown_ >= 0 ? "\r\x1b[2K" : "";
}

}  // namespace footwall::console
