#include "engine/pillars/course.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

constexpr double kReach = 1 << 23;  // voxels, as far as the lattice goes (storage/survey/lattice.h)

double cross(const ChartPoint& o, const ChartPoint& a, const ChartPoint& b) {
  return (a.strike - o.strike) * (b.dip - o.dip) - (a.dip - o.dip) * (b.strike - o.strike);
}

// The parameter on a-b nearest to p if p is within kTouch of it.
std::optional<double> foot(const ChartPoint& p, const ChartPoint& a, const ChartPoint& b) {
  const double x = b.strike - a.strike, y = b.dip - a.dip, length2 = x * x + y * y;
  double t = length2 > 0 ? ((p.strike - a.strike) * x + (p.dip - a.dip) * y) / length2 : 0;
  t = std::clamp(t, 0.0, 1.0);
  if (chart_distance(p, between(a, b, t)) > kTouch) return std::nullopt;
  return t;
}

void refuse_folds(const Course& c, const PlaceText& place_text, const JobContext& job) {
  auto folded = [&](std::size_t n) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("pillar '{}' is folded on itself near {}", c.name, place_text(c.positions[n])),
                "put its nodes in order, or split it in two");
  };
  const std::size_t segments = c.points.size() - 1;
  for (std::size_t m = 0; m < segments; ++m) {
    job.check();
    if (chart_distance(c.points[m], c.points[m + 1]) < kTouch) folded(m);
    if (m + 2 <= segments && (foot(c.points[m + 2], c.points[m], c.points[m + 1]) ||
                              foot(c.points[m], c.points[m + 1], c.points[m + 2])))
      folded(m + 1);
    for (std::size_t n = m + 2; n < segments; ++n)
      if (meetings_of(c.points[m], c.points[m + 1], c.points[n], c.points[n + 1]).count > 0) folded(m);
  }
}

Course course_of(const PillarInput& pillar, const Chart& chart, const PlaceText& place_text,
                 std::vector<std::string>& notes, const JobContext& job) {
  Course c;
  c.id = pillar.id;
  c.name = pillar.name_for_messages.empty() ? std::to_string(pillar.id) : pillar.name_for_messages;
  if (pillar.nodes.empty()) throw Error(ErrorCode::kInvalid, fmt::format("pillar '{}' has no nodes", c.name));
  require(pillar.node_ids.empty() || pillar.node_ids.size() == pillar.nodes.size(),
          "one id for each pillar node");
  std::size_t dropped = 0;
  for (std::size_t n = 0; n < pillar.nodes.size(); ++n) {
    const survey::IndexPoint& p = pillar.nodes[n];
    if (!in_reach(p))
      throw Error(ErrorCode::kInvalid,
                  fmt::format("node {} of pillar '{}' is not finite, or too far away", n + 1, c.name),
                  "nodes lie within 2^23 voxels of the survey");
    const ChartPoint q = chart.from_index(p);
    if (!in_reach({q.strike / 4, q.dip / 4, q.height / 4}))  // as the frame of nodes in reach has them
      throw Error(ErrorCode::kInvalid, "the fault's stored chart lies far away from its nodes",
                  "triangulate with --rechart");
    if (!c.points.empty() && space_distance(q, c.points.back()) < kTouch) {
      ++dropped;
      continue;
    }
    c.points.push_back(q);
    c.positions.push_back(p);
    c.node_ids.push_back(pillar.node_ids.empty() ? static_cast<std::int64_t>(n) : pillar.node_ids[n]);
  }
  if (dropped > 0)
    notes.push_back(
        fmt::format("pillar '{}': {} node(s) on top of the one before were left out", c.name, dropped));

  const double x = c.points.back().strike - c.points.front().strike,
               y = c.points.back().dip - c.points.front().dip;
  const double along = x * chart.along[0] + y * chart.along[1],
               across = x * chart.along[1] - y * chart.along[0];
  c.crosses = !c.single() && std::abs(across) > std::abs(along);
  if ((c.crosses ? across : along) < 0) {
    std::reverse(c.points.begin(), c.points.end());
    std::reverse(c.positions.begin(), c.positions.end());
    std::reverse(c.node_ids.begin(), c.node_ids.end());
    notes.push_back(fmt::format("pillar '{}' was taken in reverse, to run as its neighbours do", c.name));
  }
  refuse_folds(c, place_text, job);

  c.s.assign(c.points.size(), 0);
  double weight = 0, place = 0;
  auto place_at = [&](const ChartPoint& p) {
    return c.crosses ? p.strike * chart.along[0] + p.dip * chart.along[1]
                     : p.strike * chart.along[1] - p.dip * chart.along[0];
  };
  for (std::size_t n = 1; n < c.points.size(); ++n) {
    const double length = space_distance(c.points[n - 1], c.points[n]);
    c.s[n] = c.s[n - 1] + length;
    weight += length;
    place += length * 0.5 * (place_at(c.points[n - 1]) + place_at(c.points[n]));
  }
  c.place = c.single() ? place_at(c.points[0]) : place / weight;
  for (double& s : c.s) s = weight > 0 ? s / weight : 0;
  if (!c.single()) c.s.back() = 1;
  return c;
}

}  // namespace

bool in_reach(const survey::IndexPoint& p) {
  // False for NaN, too.
  return std::abs(p.i) <= kReach && std::abs(p.j) <= kReach && std::abs(p.k) <= kReach;
}

double chart_distance(const ChartPoint& a, const ChartPoint& b) {
  const double x = a.strike - b.strike, y = a.dip - b.dip;
  return std::sqrt(x * x + y * y);
}

double space_distance(const ChartPoint& a, const ChartPoint& b) {
  const double x = a.strike - b.strike, y = a.dip - b.dip, z = a.height - b.height;
  return std::sqrt(x * x + y * y + z * z);
}

ChartPoint between(const ChartPoint& a, const ChartPoint& b, double t) {
  return {a.strike + t * (b.strike - a.strike), a.dip + t * (b.dip - a.dip),
          a.height + t * (b.height - a.height)};
}

ChartPoint Course::at(double at) const {
  if (single()) return points[0];
  std::size_t n = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin());
  n = std::clamp<std::size_t>(n, 1, s.size() - 1);
  const double width = s[n] - s[n - 1];
  return between(points[n - 1], points[n], width > 0 ? std::clamp((at - s[n - 1]) / width, 0.0, 1.0) : 0);
}

Meetings meetings_of(const ChartPoint& p0, const ChartPoint& p1, const ChartPoint& q0, const ChartPoint& q1) {
  Meetings found;
  if (std::min(p0.strike, p1.strike) > std::max(q0.strike, q1.strike) + kTouch ||
      std::min(q0.strike, q1.strike) > std::max(p0.strike, p1.strike) + kTouch ||
      std::min(p0.dip, p1.dip) > std::max(q0.dip, q1.dip) + kTouch ||
      std::min(q0.dip, q1.dip) > std::max(p0.dip, p1.dip) + kTouch)
    return found;
  if (const auto v = foot(p0, q0, q1)) found.add(0, *v);
  if (const auto v = foot(p1, q0, q1)) found.add(1, *v);
  if (const auto u = foot(q0, p0, p1)) found.add(*u, 0);
  if (const auto u = foot(q1, p0, p1)) found.add(*u, 1);
  if (found.count > 0) return found;
  const double a = cross(q0, q1, p0), b = cross(q0, q1, p1), c = cross(p0, p1, q0), d = cross(p0, p1, q1);
  if ((a > 0) != (b > 0) && (c > 0) != (d > 0)) found.add(a / (a - b), c / (c - d));
  return found;
}

std::vector<Course> courses_of(std::span<const PillarInput> pillars, const Chart& chart,
                               std::vector<std::string>& notes, const PlaceText& place_text,
                               const JobContext& job) {
  std::vector<const PillarInput*> by_id;
  for (const PillarInput& p : pillars) by_id.push_back(&p);
  std::stable_sort(by_id.begin(), by_id.end(),
                   [](const PillarInput* a, const PillarInput* b) { return a->id < b->id; });
  std::vector<Course> courses;
  for (const PillarInput* p : by_id) {
    if (!courses.empty() && courses.back().id == p->id)
      throw Error(ErrorCode::kInvalid, fmt::format("two pillars have the id {}", p->id));
    courses.push_back(course_of(*p, chart, place_text, notes, job));
  }
  std::stable_sort(courses.begin(), courses.end(), [](const Course& a, const Course& b) {
    return std::tie(a.crosses, a.place, a.id) < std::tie(b.crosses, b.place, b.id);
  });
  return courses;
}

}  // namespace footwall::pillars
