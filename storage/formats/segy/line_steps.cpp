#include "storage/formats/segy/line_steps.h"

#include <algorithm>
#include <map>

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kFar = 50;  // steps between the main body of lines and one that is none of it

std::int64_t remainder_of(std::int64_t line, std::int64_t step) {
  return ((line % step) + step) % step;
}

// Calls visit(line, traces) for each different line.
template <class Visit>
void for_each_line(std::span<const std::int32_t> lines, const Visit& visit) {
  for (std::size_t first = 0; first < lines.size();) {
    std::size_t end = first + 1;
    while (end < lines.size() && lines[end] == lines[first]) ++end;
    visit(std::int64_t{lines[first]}, static_cast<std::int64_t>(end - first));
    first = end;
  }
}

// The difference of neighbouring lines that most traces have; 0 for a single line.
std::int64_t usual_step(std::span<const std::int32_t> lines) {
  std::map<std::int64_t, std::int64_t> votes;
  bool any = false;
  std::int64_t before = 0;
  for_each_line(lines, [&](std::int64_t line, std::int64_t traces) {
    if (any && (votes.size() < 4096 || votes.contains(line - before))) votes[line - before] += traces;
    before = line;
    any = true;
  });
  const auto most = std::max_element(votes.begin(), votes.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? 0 : most->first;
}

// The remainder, from 0, that most traces' lines leave.
std::int64_t usual_remainder(std::span<const std::int32_t> lines, std::int64_t step) {
  std::map<std::int64_t, std::int64_t> votes;
  for_each_line(lines, [&](std::int64_t line, std::int64_t traces) {
    const std::int64_t rest = remainder_of(line, step);
    if (votes.size() < 4096 || votes.contains(rest)) votes[rest] += traces;
  });
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

LineSteps main_steps_of(std::span<const std::int32_t> lines) {
  StepsSoFar every;
  for (const std::int32_t line : lines) every.add(line);
  const LineSteps all = every.steps();
  const std::int64_t step = usual_step(lines);
  if (step == 0) return all;
  const std::int64_t remainder = usual_remainder(lines, step);
  // Bodies of lines on the usual multiples, apart from each other by no more than kFar steps: the largest.
  std::int64_t body_first = 0, body_last = 0, body_traces = 0;
  std::int64_t first = 0, last = 0, traces = 0;
  const auto close = [&] {
    if (traces > body_traces) {
      body_first = first;
      body_last = last;
      body_traces = traces;
    }
  };
  for_each_line(lines, [&](std::int64_t line, std::int64_t here) {
    if (remainder_of(line, step) != remainder) return;
    if (traces == 0 || line - last > kFar * step) {
      close();
      first = line;
      traces = 0;
    }
    last = line;
    traces += here;
  });
  close();
  const auto whole = static_cast<std::int64_t>(lines.size());
  const std::int64_t left_out = whole - body_traces;
  if (left_out > (whole < 16 ? 0 : std::max<std::int64_t>(1, whole / 50))) return all;
  StepsSoFar kept;
  for (const std::int32_t line : lines) {
    if (line >= body_first && line <= body_last && remainder_of(line, step) == remainder) kept.add(line);
  }
  const LineSteps body = kept.steps();
  return 2 * body.count() <= all.count() + 1 ? body : all;
}

}  // namespace footwall::formats::segy
