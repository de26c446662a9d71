#include "engine/pillars/interpolate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/pillars/course.h"
#include "engine/pillars/thin_plate.h"
#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

constexpr int kDeepestHalving = 6;  // at most 63 pillars between two by tolerance

void check_options(const InterpolateOptions& o) {
  if (!(o.smoothing >= 0) || !std::isfinite(o.smoothing))
    throw Error(ErrorCode::kUsage, "the thin plate's smoothing must not be negative");
  if (!(o.dip_anisotropy > 0) || !std::isfinite(o.dip_anisotropy))
    throw Error(ErrorCode::kUsage, "the dip anisotropy must be positive");
}

// The thin plate over a fault's chart.
class Plate {
 public:
  Plate(const std::vector<Course>& courses, const InterpolateOptions& options, const JobContext& job,
        std::vector<std::string>& notes)
      : anisotropy_(options.dip_anisotropy),
        plate_(nodes_of(courses, anisotropy_, notes), options.smoothing, job) {}

  double height(const ChartPoint& p) const { return plate_.height(p.strike, anisotropy_ * p.dip); }

 private:
  static std::vector<PlateNode> nodes_of(const std::vector<Course>& courses, double anisotropy,
                                         std::vector<std::string>& notes) {
    std::vector<PlateNode> all;
    for (const Course& c : courses)
      for (const ChartPoint& p : c.points) all.push_back({p.strike, anisotropy * p.dip, p.height});
    if (all.size() <= kThinPlatePoints) return all;
    notes.push_back(fmt::format("the thin plate was fitted to {} of {} nodes, evenly thinned",
                                kThinPlatePoints, all.size()));
    std::vector<PlateNode> some;
    for (std::size_t n = 0; n < kThinPlatePoints; ++n) some.push_back(all[n * all.size() / kThinPlatePoints]);
    return some;
  }

  double anisotropy_;
  ThinPlate plate_;
};

class Between {
 public:
  Between(const Course& a, const Course& b, const Plate& plate, const Chart& chart)
      : a_(a),
        b_(b),
        plate_(plate),
        chart_(chart),
        count_(std::max<std::size_t>({a.points.size(), b.points.size(), 2})) {
    if (a.single() && b.single()) count_ = 1;
  }

  // The pillar at parameter t from a to b. Its height is kept within one pillar spacing of the straight line.
  std::vector<ChartPoint> points_at(double t, bool* limited = nullptr) const {
    std::vector<ChartPoint> points;
    for (std::size_t n = 0; n < count_; ++n) {
      const double s = count_ > 1 ? double(n) / double(count_ - 1) : 0;
      const ChartPoint p = a_.at(s), q = b_.at(s);
      ChartPoint middle = between(p, q, t);
      const double spacing = space_distance(p, q), plate = plate_.height(middle);
      const double height = std::clamp(plate, middle.height - spacing, middle.height + spacing);
      if (limited && height != plate) *limited = true;
      middle.height = height;
      points.push_back(middle);
    }
    return points;
  }

  // The largest difference in height between the pillar at the middle of two and their own middle.
  double bend(double from, double to) const {
    const auto low = from == 0 ? own(a_) : points_at(from), high = to == 1 ? own(b_) : points_at(to);
    double worst = 0;
    for (double part : {0.25, 0.5, 0.75}) {
      const auto middle = points_at(from + part * (to - from));
      for (std::size_t n = 0; n < middle.size(); ++n)
        worst = std::max(worst, std::abs(middle[n].height - between(low[n], high[n], part).height));
    }
    return worst;
  }

  InterpolatedPillar pillar_at(double t, const Parents& parents, bool& limited) const {
    InterpolatedPillar pillar{parents, {}};
    for (const ChartPoint& p : points_at(t, &limited)) pillar.nodes.push_back(chart_.to_index(p));
    return pillar;
  }

 private:
  std::vector<ChartPoint> own(const Course& c) const {
    std::vector<ChartPoint> points;
    for (std::size_t n = 0; n < count_; ++n)
      points.push_back(c.at(count_ > 1 ? double(n) / double(count_ - 1) : 0));
    return points;
  }

  const Course &a_, &b_;
  const Plate& plate_;
  const Chart& chart_;
  std::size_t count_;
};

survey::IndexPoint middle_of(const Course& c) {
  survey::IndexPoint sum;
  for (const auto& p : c.positions) sum = {sum.i + p.i, sum.j + p.j, sum.k + p.k};
  const double n = double(c.positions.size());
  return {sum.i / n, sum.j / n, sum.k / n};
}

// How many lines lie between two pillars: along the axis of the sections that both were picked on, otherwise
// along the one of inline and crossline on which their middles differ more.
double lines_between(const Course& a, const Course& b) {
  auto on_section = [](const Course& c, double survey::IndexPoint::*axis) {
    const auto [low, high] =
        std::minmax_element(c.positions.begin(), c.positions.end(),
                            [&](const auto& x, const auto& y) { return x.*axis < y.*axis; });
    return (*high).*axis - (*low).*axis < 0.5;
  };
  const survey::IndexPoint p = middle_of(a), q = middle_of(b);
  for (const auto axis : {&survey::IndexPoint::i, &survey::IndexPoint::j, &survey::IndexPoint::k})
    if (!a.single() && !b.single() && on_section(a, axis) && on_section(b, axis))
      return std::abs(p.*axis - q.*axis);
  return std::max(std::abs(p.i - q.i), std::abs(p.j - q.j));
}

void halve(const Between& gap, double from, double to, double tolerance, int depth, std::vector<double>& at,
           const JobContext& job) {
  job.check();
  if (depth == kDeepestHalving || gap.bend(from, to) <= tolerance) return;
  const double middle = 0.5 * (from + to);
  halve(gap, from, middle, tolerance, depth + 1, at, job);
  at.push_back(middle);
  halve(gap, middle, to, tolerance, depth + 1, at, job);
}

Chart chart_for(std::span<const PillarInput> picked, const std::optional<Chart>& chart) {
  if (picked.size() < 2)
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("the fault has {} picked pillar(s); pillars are inserted between two", picked.size()),
        "pick the fault on another section");
  return chart && !chart->empty() ? *chart : fit_chart(picked);
}

}  // namespace

Interpolation interpolate(std::span<const PillarInput> picked, const InterpolateOptions& options,
                          const std::optional<Chart>& chart, const JobContext& job) {
  check_options(options);
  const std::optional<double> spacing = options.every_lines ? options.every_lines : options.tolerance;
  if (options.every_lines.has_value() == options.tolerance.has_value() || !(*spacing > 0) ||
      !std::isfinite(*spacing))
    throw Error(ErrorCode::kUsage,
                "give either a positive number of lines (--every) or a positive tolerance (--tolerance)");
  const Chart frame = chart_for(picked, chart);
  Interpolation result;
  std::vector<std::string>
      about_courses;  // what triangulate says about the picked pillars is not repeated here
  const std::vector<Course> courses = courses_of(picked, frame, about_courses, options.place_text, job);
  const Plate plate(courses, options, job, result.notes);
  std::size_t limited_pillars = 0;
  for (std::size_t n = 0; n + 1 < courses.size(); ++n) {
    job.report(0.5 + 0.5 * double(n) / double(courses.size()), "interpolate");
    const Course &a = courses[n], &b = courses[n + 1];
    if (a.crosses || b.crosses) continue;
    const Between gap(a, b, plate, frame);
    std::vector<double> at;
    if (options.every_lines) {
      const double pieces = std::ceil(lines_between(a, b) / *options.every_lines - 1e-9);
      if (!(pieces <= double(kInsertedPillars - result.pillars.size())))
        throw Error(ErrorCode::kMemory,
                    fmt::format("more than {} pillars would be inserted", kInsertedPillars),
                    "ask for fewer with a larger --every");
      for (int k = 1; k < pieces; ++k) at.push_back(k / pieces);
    } else {
      halve(gap, 0, 1, *options.tolerance, 0, at, job);
      if (at.size() > kInsertedPillars - result.pillars.size())
        throw Error(ErrorCode::kMemory,
                    fmt::format("more than {} pillars would be inserted", kInsertedPillars),
                    "ask for fewer with a larger --tolerance");
    }
    for (double t : at) {
      bool limited = false;
      result.pillars.push_back(gap.pillar_at(t, {a.id, b.id, t}, limited));
      limited_pillars += limited;
    }
  }
  const auto crossing =
      std::count_if(courses.begin(), courses.end(), [](const Course& c) { return c.crosses; });
  if (crossing > 0)
    result.notes.push_back(fmt::format(
        "{} pillar(s) cross the fault's main direction: none were inserted beside them", crossing));
  if (limited_pillars > 0)
    result.notes.push_back(fmt::format(
        "{} pillar(s) were kept within one pillar spacing of the straight line", limited_pillars));
  return result;
}

Interpolation regenerate(std::span<const PillarInput> picked, std::span<const Parents> parents,
                         const InterpolateOptions& options, const std::optional<Chart>& chart,
                         const JobContext& job) {
  check_options(options);
  const Chart frame = chart_for(picked, chart);
  Interpolation result;
  std::vector<std::string> about_courses;
  const std::vector<Course> courses = courses_of(picked, frame, about_courses, options.place_text, job);
  const Plate plate(courses, options, job, result.notes);
  auto course = [&](std::int64_t id) -> const Course& {
    for (const Course& c : courses)
      if (c.id == id) return c;
    throw Error(ErrorCode::kNotFound,
                fmt::format("the interpolated pillar's parent {} is not among the picked pillars", id),
                "delete the interpolated pillar");
  };
  for (const Parents& p : parents) {
    require(p.parameter > 0 && p.parameter < 1, "an interpolated pillar's parameter lies between 0 and 1");
    job.check();
    bool limited = false;
    result.pillars.push_back(
        Between(course(p.a), course(p.b), plate, frame).pillar_at(p.parameter, p, limited));
  }
  return result;
}

}  // namespace footwall::pillars
