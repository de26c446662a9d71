#include "storage/formats/detail/stick_collector.h"

#include <fmt/format.h>
#include <algorithm>

#include <cmath>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/names.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::detail {
namespace {

constexpr std::string_view kUnnamed = "unnamed";
constexpr std::size_t kAnyLength = std::string_view::npos;
constexpr std::size_t kLongestReason = 300;

survey::IndexPoint index_of_lines(const survey::Geometry& survey, double inline_number,
                                  double crossline_number) {
  return {(inline_number - survey.inlines.first) / survey.inlines.step,
          (crossline_number - survey.crosslines.first) / survey.crosslines.step, 0};
}

}  // namespace

StickCollector::StickCollector(const SticksOptions& options) : options_(options) {
  if (!options_.z_unit.empty() && !options_.vertical_unit.empty()) {
    z_unit_factor(options_.z_unit, options_.vertical_unit);
  }
}

void StickCollector::file_states(std::optional<bool> z_positive_up, std::string_view z_unit) {
  apply_z_rule(z_positive_up, z_unit);
}

void StickCollector::apply_z_rule(std::optional<bool> stated_up, std::string_view stated_unit) {
  z_ruled_ = true;
  const bool up = options_.z_positive_up.value_or(stated_up.value_or(false));
  assume(fmt::format("z is positive {}{}", up ? "up" : "down",
                     options_.z_positive_up ? ", as told"
                     : stated_up            ? ", as the file says"
                                            : ""));
  const bool told = !options_.z_unit.empty();
  const std::string unit = told ? options_.z_unit : std::string(stated_unit);
  const std::string& target = options_.vertical_unit;
  double factor = 1;
  if (unit.empty()) {
    assume(target.empty() ? "z is kept in the file's unit, which is not known: the project has no survey"
                          : "z is in the survey's vertical unit");
  } else {
    if (!target.empty()) {
      try {
        factor = z_unit_factor(unit, target);
      } catch (const Error& error) {
        if (told) throw;
        throw Error(ErrorCode::kInvalid,
                    fmt::format("the file says that its z is in {}, and the survey's is in {}", unit, target),
                    "where the file is wrong, --z-unit tells the unit; between time and depth nothing is "
                    "converted");
      }
    }
    assume(fmt::format("z is in {}, as {}{}", unit, told ? "told" : "the file says",
                       target.empty()   ? "; it is kept so: the project has no survey"
                       : target == unit ? ""
                                        : ", and converted into " + target));
  }
  z_factor_ = up ? -factor : factor;
}

void StickCollector::assume(std::string what) {
  std::vector<std::string>& assumed = result_.report.assumed;
  if (std::find(assumed.begin(), assumed.end(), what) == assumed.end()) assumed.push_back(std::move(what));
}

void StickCollector::rename(std::string_view old_name, std::string_view new_name) {
  result_.report.renamed.push_back(fmt::format("{} -> {}", old_name, new_name));
}

void StickCollector::reject(std::int64_t line, const RowError& why) {
  ImportReport& report = result_.report;
  ++report.rejected_count;
  if (report.rejected.size() < ImportReport::kListedRejects) {
    report.rejected.push_back(
        {line, static_cast<std::int64_t>(why.at) + 1, clean_name(why.reason, kLongestReason)});
  }
}

// Two long names that differ only where they are cut stay two names.
std::string StickCollector::short_name(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  std::string shorter = clean_name(name);
  for (int n = 2; !cut_names_.insert(shorter).second; ++n) {
    const std::string suffix = fmt::format(" ({})", n);
    shorter = clean_name(name, kLongestName - suffix.size()) + suffix;
  }
  return shorter;
}

StickCollector::Fault& StickCollector::fault_of(std::string_view name_in_file) {
  if (last_ != names_in_file_.end() && last_->first == name_in_file) return *last_->second;
  last_ = names_in_file_.find(name_in_file);
  if (last_ != names_in_file_.end()) return *last_->second;

  std::string name = clean_name(name_in_file, kAnyLength);
  if (name.empty()) name = clean_name(options_.fault, kAnyLength);
  if (name.empty()) name = kUnnamed;
  Fault& fault = faults_[name];
  if (fault.name.empty()) fault.name = short_name(name);
  if (!name_in_file.empty() && fault.name != name_in_file) rename(as_utf8(name_in_file), fault.name);
  last_ = names_in_file_.emplace(name_in_file, &fault).first;
  return fault;
}

std::size_t StickCollector::stick_of(Fault& fault, const std::optional<std::int64_t>& number) {
  const auto start = [&](std::int64_t stick, bool numbered) {
    result_.sticks.push_back({fault.name, stick, {}});
    numbered_.push_back(numbered);
    return result_.sticks.size() - 1;
  };
  if (number) {
    const auto found = fault.numbered.find(*number);
    if (found != fault.numbered.end()) return found->second;
    return fault.numbered[*number] = start(*number, true);
  }
  // The rows of a stick stand together: another fault's rows end it as a blank line does.
  const bool others_between = fault.open && *fault.open + 1 != result_.sticks.size();
  if (!fault.open || stick_ended_ || others_between) {
    if (stick_ended_ && !result_.sticks.empty()) parted_ = true;
    fault.open = start(++fault.unnumbered, false);
  }
  return *fault.open;
}

// Of a knot with X, Y and lines: how many lines they differ by.
double StickCollector::apart(const Knot& knot) const {
  const survey::IndexPoint by_xy = options_.survey->index_of({(*knot.xy)[0], (*knot.xy)[1], 0});
  const survey::IndexPoint by_lines = index_of_lines(*options_.survey, (*knot.lines)[0], (*knot.lines)[1]);
  return std::max(std::fabs(by_xy.i - by_lines.i), std::fabs(by_xy.j - by_lines.j));
}

void StickCollector::compare(const Knot& knot) {
  const double lines = apart(knot);
  if (!(lines > 1) || contradict_++ > 0) return;
  first_contradiction_ = fmt::format("first: X {} Y {} with inline {} and crossline {}, {:.1f} lines apart",
                                     (*knot.xy)[0], (*knot.xy)[1], (*knot.lines)[0], (*knot.lines)[1], lines);
}

survey::WorldPoint StickCollector::placed(const Knot& knot, bool& in_line_numbers) {
  const double z = knot.z * z_factor_;
  const bool has_lines = knot.lines && ((*knot.lines)[0] != 0 || (*knot.lines)[1] != 0);
  const bool has_xy = knot.xy && (!has_lines || (*knot.xy)[0] != 0 || (*knot.xy)[1] != 0);
  if (has_xy) {
    if (knot.lines && !has_lines) ++without_lines_;
    if (has_lines && options_.survey) compare(knot);
    return {(*knot.xy)[0], (*knot.xy)[1], z};
  }
  if (!knot.lines) throw RowError{0, "the row has no X and Y"};
  if (options_.survey) {
    const survey::WorldPoint at =
        options_.survey->world_of(index_of_lines(*options_.survey, (*knot.lines)[0], (*knot.lines)[1]));
    if (knot.xy && apart(knot) <= 1) return {0, 0, z};  // 0 0 is where it is
    if (knot.xy) ++by_lines_;
    return {at.x, at.y, z};
  }
  if (knot.xy) {
    throw RowError{0, "X and Y are 0 0, and without a survey inline and crossline cannot place the row"};
  }
  in_line_numbers = true;
  return {(*knot.lines)[0], (*knot.lines)[1], z};
}

void StickCollector::add(const Knot& knot) {
  if (!z_ruled_) apply_z_rule(std::nullopt, "");
  bool in_line_numbers = false;
  const survey::WorldPoint point = placed(knot, in_line_numbers);
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    throw RowError{0, "the position is beyond all bounds"};
  }
  Fault& fault = fault_of(knot.name);
  if (knot.name.empty()) ++unnamed_;
  Stick& stick = result_.sticks[stick_of(fault, knot.stick)];
  stick_ended_ = false;
  stick.in_line_numbers = in_line_numbers;
  if (!stick.points.empty() && stick.points.back() == point) {
    ++result_.report.skipped;
    return;
  }
  stick.points.push_back(point);
  ++result_.report.read;
}

void StickCollector::split_at_planes() {
  const auto unnumbered = std::count(numbered_.begin(), numbered_.end(), false);
  if (unnumbered == 0 || parted_) return;
  if (!options_.survey) {
    assume("no stick numbers and no blank lines: the rows of a fault that follow each other are one stick");
    return;
  }
  const survey::Geometry& survey = *options_.survey;
  std::vector<Stick> split;
  std::map<std::string_view, std::int64_t> count;
  for (std::size_t n = 0; n < result_.sticks.size(); ++n) {
    Stick& stick = result_.sticks[n];
    if (numbered_[n]) {
      split.push_back(std::move(stick));
      continue;
    }
    // The planes that all knots so far share with the stick's first.
    std::array<bool, 3> shared{};
    survey::IndexPoint first;
    bool started = false;
    for (const survey::WorldPoint& point : stick.points) {
      const survey::IndexPoint at = survey.index_of(point);
      const std::array<bool, 3> left{shared[0] && std::fabs(at.i - first.i) <= 0.5,
                                     shared[1] && std::fabs(at.j - first.j) <= 0.5,
                                     shared[2] && std::fabs(at.k - first.k) <= 0.5};
      if (started && (left[0] || left[1] || left[2])) {
        shared = left;
      } else {
        split.push_back({stick.fault, ++count[stick.fault], {}});
        shared = {true, true, true};
        first = at;
        started = true;
      }
      split.back().points.push_back(point);
    }
  }
  assume(
      fmt::format("no stick numbers and no blank lines: a stick ends where its plane (inline, crossline or "
                  "z) is left, which makes {} sticks",
                  split.size()));
  result_.sticks = std::move(split);
}

SticksImport StickCollector::finish(std::string_view what, std::string_view hint) {
  ImportReport& report = result_.report;
  if (result_.sticks.empty()) {
    std::string why = fmt::format("no row is {}", what);
    if (!report.rejected.empty()) {
      why += fmt::format("; line {}: {}", report.rejected.front().line, report.rejected.front().reason);
    }
    throw Error(ErrorCode::kFormat, why, std::string(hint));
  }
  split_at_planes();
  if (without_lines_ > 0) {
    assume(fmt::format("{} rows have line numbers 0 0 and are placed by X and Y alone", without_lines_));
  }
  if (by_lines_ > 0) {
    assume(fmt::format("{} rows have X and Y 0 0 and are placed by inline and crossline", by_lines_));
  }
  if (unnamed_ > 0) {
    assume(fmt::format("{} rows have no fault name and belong to '{}'", unnamed_,
                       names_in_file_.find(std::string_view{})->second->name));
  }
  if (contradict_ > 0) {
    result_.notices.push_back(fmt::format(
        "X and Y of {} rows contradict their inline and crossline by more than a bin and are used; {}",
        contradict_, first_contradiction_));
  }
  return std::move(result_);
}

std::string written_name(std::string_view name, std::string_view forbidden, bool blanks,
                         std::vector<std::string>& renamed) {
  std::string out;
  for (const char c : name) {
    if (c == ' ' && out.ends_with(' ')) continue;
    out.push_back(forbidden.find(c) != std::string_view::npos ? '_' : c);
  }
  if (blanks) std::replace(out.begin(), out.end(), ' ', '_');
  if (out != name) {
    std::string line = fmt::format("{} -> {}", name, out);
    if (std::find(renamed.begin(), renamed.end(), line) == renamed.end()) renamed.push_back(std::move(line));
  }
  return out;
}

double written_z(double z, const SticksWriteOptions& options) {
  return (options.z_positive_up ? -z : z) + 0.0;
}

std::array<std::int64_t, 2> nearest_lines(const survey::WorldPoint& point,
                                          const SticksWriteOptions& options) {
  if (!options.survey) return {0, 0};
  const survey::IndexPoint at = options.survey->index_of(point);
  constexpr double kFar = 2147483648.0;
  if (!(std::fabs(at.i) < kFar && std::fabs(at.j) < kFar)) return {0, 0};
  return {options.survey->inlines.line_of(std::llround(at.i)),
          options.survey->crosslines.line_of(std::llround(at.j))};
}

}  // namespace footwall::formats::detail
