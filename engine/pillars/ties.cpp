#include "engine/pillars/ties.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

constexpr double kSamePlace = 4 * kTouch;  // meetings closer than this along a pillar are one

struct Segment {
  std::int32_t course;
  std::int32_t number;
  double low, high;  // extent along strike
};

struct Encounter {
  std::int32_t a, b;  // courses, a < b
  double at_a, at_b;  // distance along them in the chart
  ChartPoint on_a, on_b;
};

std::vector<Encounter> encounters_of(const std::vector<Course>& courses, const JobContext& job) {
  std::vector<Segment> segments;
  std::vector<std::vector<double>> lengths;
  for (std::size_t c = 0; c < courses.size(); ++c) {
    lengths.push_back(chart_lengths(courses[c]));
    const auto& p = courses[c].points;
    // A single node counts as a segment without length, so that nothing may pass over it.
    for (std::size_t n = 0; n + 1 < std::max<std::size_t>(p.size(), 2); ++n) {
      const double x = p[n].strike, y = p[std::min(n + 1, p.size() - 1)].strike;
      segments.push_back(
          {static_cast<std::int32_t>(c), static_cast<std::int32_t>(n), std::min(x, y), std::max(x, y)});
    }
  }
  std::sort(segments.begin(), segments.end(), [](const Segment& x, const Segment& y) {
    return std::tie(x.low, x.course, x.number) < std::tie(y.low, y.course, y.number);
  });
  std::vector<Encounter> found;
  for (std::size_t m = 0; m < segments.size(); ++m) {
    job.check();
    for (std::size_t n = m + 1; n < segments.size() && segments[n].low <= segments[m].high + kTouch; ++n) {
      const bool swap = segments[n].course < segments[m].course;
      const Segment &p = swap ? segments[n] : segments[m], &q = swap ? segments[m] : segments[n];
      if (p.course == q.course) continue;
      auto end = [&](const Segment& s, int which) {
        const auto& points = courses[s.course].points;
        return points[std::min<std::size_t>(static_cast<std::size_t>(s.number + which), points.size() - 1)];
      };
      const ChartPoint p0 = end(p, 0), p1 = end(p, 1), q0 = end(q, 0), q1 = end(q, 1);
      const Meetings meetings = meetings_of(p0, p1, q0, q1);
      for (int k = 0; k < meetings.count; ++k) {
        const Meeting& at = meetings.at[static_cast<std::size_t>(k)];
        found.push_back({p.course, q.course, lengths[p.course][p.number] + at.u * chart_distance(p0, p1),
                         lengths[q.course][q.number] + at.v * chart_distance(q0, q1), between(p0, p1, at.u),
                         between(q0, q1, at.v)});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const Encounter& x, const Encounter& y) {
    return std::tie(x.a, x.b, x.at_a, x.at_b) < std::tie(y.a, y.b, y.at_a, y.at_b);
  });
  return found;
}

}  // namespace

std::vector<double> chart_lengths(const Course& course) {
  std::vector<double> lengths{0};
  for (std::size_t n = 1; n < course.points.size(); ++n)
    lengths.push_back(lengths.back() + chart_distance(course.points[n - 1], course.points[n]));
  return lengths;
}

std::vector<Tie> ties_of(const std::vector<Course>& courses, const Chart& chart, double tolerance,
                         const PlaceText& place_text, std::vector<MisTie>& mis_ties, const JobContext& job) {
  // 1. One encounter for each place; two ends of an overlap are two places with nothing between the courses
  // there.
  std::vector<Encounter> places;
  for (const Encounter& e : encounters_of(courses, job)) {
    if (!places.empty()) {
      const Encounter& last = places.back();
      if (last.a == e.a && last.b == e.b && std::abs(last.at_a - e.at_a) < kSamePlace &&
          std::abs(last.at_b - e.at_b) < kSamePlace)
        continue;
      if (last.a == e.a && last.b == e.b) {
        const double run = e.at_a - last.at_a;
        const Course &a = courses[e.a], &b = courses[e.b];
        const std::vector<double> along_a = chart_lengths(a), along_b = chart_lengths(b);
        auto at = [](const Course& c, const std::vector<double>& lengths, double length) {
          std::size_t n = static_cast<std::size_t>(std::upper_bound(lengths.begin(), lengths.end(), length) -
                                                   lengths.begin());
          n = std::clamp<std::size_t>(n, 1, lengths.size() - 1);
          return between(c.points[n - 1], c.points[n],
                         (length - lengths[n - 1]) / (lengths[n] - lengths[n - 1]));
        };
        bool together = !a.single() && !b.single();
        for (int k = 1; together && k < 4; ++k)
          together = chart_distance(at(a, along_a, last.at_a + run * k / 4),
                                    at(b, along_b, last.at_b + (e.at_b - last.at_b) * k / 4)) < 2 * kTouch;
        if (together)
          throw Error(ErrorCode::kInvalid,
                      fmt::format("pillars '{}' and '{}' lie on one another near {}", a.name, b.name,
                                  place_text(chart.to_index(e.on_a))),
                      "delete one of the two");
      }
    }
    places.push_back(e);
  }
  // 2. Beyond the tolerance they are not the same fault: name the worst.
  const Encounter* worst = nullptr;
  double worst_gap = tolerance;
  std::size_t beyond = 0;
  for (const Encounter& e : places) {
    const double gap = std::abs(e.on_a.height - e.on_b.height);
    beyond += gap > tolerance;
    if (gap > worst_gap) worst_gap = gap, worst = &e;
    const ChartPoint middle = {0.5 * (e.on_a.strike + e.on_b.strike), 0.5 * (e.on_a.dip + e.on_b.dip),
                               0.5 * (e.on_a.height + e.on_b.height)};
    const std::int64_t a = courses[e.a].id, b = courses[e.b].id;
    mis_ties.push_back({std::min(a, b), std::max(a, b), gap, chart.to_index(middle)});
  }
  if (worst)
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("pillars '{}' and '{}' cross near {} with {:.2f} voxels between them (tolerance {:g}){}",
                    courses[worst->a].name, courses[worst->b].name, place_text(chart.to_index(worst->on_a)),
                    worst_gap, tolerance,
                    beyond > 1 ? fmt::format("; {} more crossings are beyond it", beyond - 1) : ""),
        "move their nodes together there, or split the fault");
  // 3. Encounters at one place of a course are one tie, of three pillars or more.
  std::map<std::pair<std::int32_t, std::int64_t>, std::vector<std::size_t>>
      by_stop;  // course, cell of its length
  std::vector<Tie> ties;
  std::vector<std::vector<ChartPoint>> met;
  for (const Encounter& e : places) {
    std::size_t found = ties.size();
    for (const auto& [course, length] : {std::pair{e.a, e.at_a}, std::pair{e.b, e.at_b}}) {
      const auto cell = static_cast<std::int64_t>(std::floor(length / kSamePlace));
      for (std::int64_t near = cell - 1; near <= cell + 1; ++near) {
        const auto it = by_stop.find({course, near});
        if (it == by_stop.end()) continue;
        for (std::size_t t : it->second)
          for (const auto& stop : ties[t].stops)
            if (stop.first == course && std::abs(stop.second - length) < kSamePlace)
              found = std::min(found, t);
      }
    }
    if (found == ties.size()) ties.emplace_back(), met.emplace_back();
    for (const auto& [course, length, point] :
         {std::tuple{e.a, e.at_a, e.on_a}, std::tuple{e.b, e.at_b, e.on_b}}) {
      auto& stops = ties[found].stops;
      if (std::any_of(stops.begin(), stops.end(), [c = course](const auto& s) { return s.first == c; }))
        continue;
      stops.emplace_back(course, length);
      met[found].push_back(point);
      by_stop[{course, static_cast<std::int64_t>(std::floor(length / kSamePlace))}].push_back(found);
    }
  }
  for (std::size_t t = 0; t < ties.size(); ++t) {
    ChartPoint sum;
    for (const ChartPoint& p : met[t]) sum = {sum.strike + p.strike, sum.dip + p.dip, sum.height + p.height};
    const double n = static_cast<double>(met[t].size());
    ties[t].point = {sum.strike / n, sum.dip / n, sum.height / n};
    std::sort(ties[t].stops.begin(), ties[t].stops.end());
  }
  return ties;
}

}  // namespace footwall::pillars
