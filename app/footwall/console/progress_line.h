// How progress is shown on stderr: a bar on a terminal; one line per 5 % or 30 s in a file.
#pragma once
#include <chrono>
#include <string>

#include "storage/base/job_context.h"

namespace footwall::console {

class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  ProgressLine(bool terminal, int columns, Clock::time_point start);

  // The text to write for this report, with its line end or carriage return; empty when nothing is due.
  std::string update(const Progress& progress, Clock::time_point now);
  // What ends the bar (clears the terminal's line); empty in a file.
  std::string end() const;

 private:
  bool terminal_;
  int columns_;
  Clock::time_point start_;
  Clock::time_point shown_at_;
  double shown_ = -1;
  std::string shown_phase_;
};

// "3 s", "2 min 05 s", "1 h 12 min".
std::string spoken(std::chrono::seconds duration);

}  // namespace footwall::console
