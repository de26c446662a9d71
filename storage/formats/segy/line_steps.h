// The numbers of the lines on one axis of a grid: from, to, in steps of; and those that lie off it.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

namespace footwall::formats::segy {

struct LineSteps {
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
  std::int64_t step = 1;  // the greatest common divisor of all differences, > 0
  std::int64_t count() const { return (highest - lowest) / step + 1; }
  bool has(std::int64_t line) const {
    return line >= lowest && line <= highest && (line - lowest) % step == 0;
  }
};

// Finds the steps of lines that come one by one, in any order.
class StepsSoFar {
 public:
  void add(std::int64_t line) {
    if (!any_) first_ = lowest_ = highest_ = line;
    any_ = true;
    lowest_ = std::min(lowest_, line);
    highest_ = std::max(highest_, line);
    // Most differences are multiples of the step found so far, which the remainder tells faster than gcd.
    const std::int64_t difference = line - first_;
    if (step_ == 0 || difference % step_ != 0) step_ = std::gcd(step_, difference);
  }
  LineSteps steps() const { return {lowest_, highest_, step_ == 0 ? 1 : step_}; }

 private:
  bool any_ = false;
  std::int64_t first_ = 0, lowest_ = 0, highest_ = 0, step_ = 0;
};

// The steps of the main body of lines: neighbours by the most common difference, without lines that stand off
// its multiples or far away from it. All lines where that leaves out more than one trace in 50
// (or any, below 16), or does not halve the axis. lines: one number a trace, sorted, not empty.
LineSteps main_steps_of(std::span<const std::int32_t> lines);

}  // namespace footwall::formats::segy
