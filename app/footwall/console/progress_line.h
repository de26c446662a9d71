// How progress is shown on stderr: a bar on a terminal; one line per 5 % or 30 s in a file; each with the
// amounts (and rate) that the job reports and the time left.
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
  // "12 s left", with what stands before it; empty where nothing can be said.
  std::string time_left(const Progress& progress, Clock::time_point now);

  bool terminal_;
  int columns_;
  Clock::time_point shown_at_;
  struct Mark {
    Clock::time_point at;
    double fraction = 0;
  };
  // The time left is told from the pace since a few seconds ago, not since the start: a job has fast and slow
  // parts.
  Mark older_, newer_;
  double shown_ = -1;
  std::string shown_phase_;
};

// "3 s", "2 min 05 s", "1 h 12 min".
std::string spoken(std::chrono::seconds duration);

}  // namespace footwall::console
