// A pillar's course through the chart: cleaned of duplicate nodes, turned to run with the chart, measured.
#pragma once
#include <optional>
#include <vector>

#include "engine/pillars/chart.h"
#include "engine/pillars/place_text.h"
#include "storage/base/job_context.h"

namespace footwall::pillars {

struct Course {
  std::int64_t id = 0;
  std::string name;
  bool crosses = false;  // runs across the chart's main direction
  double place = 0;      // orders the courses of a family: mean distance across its direction
  // One for each node kept, at least one.
  std::vector<ChartPoint> points;
  std::vector<survey::IndexPoint> positions;
  std::vector<std::int64_t> node_ids;
  std::vector<double> s;  // normalised length along the polyline, 0 to 1; {0} for a single node

  bool single() const { return points.size() == 1; }
  // The point at normalised length `at`.
  ChartPoint at(double at) const;
};

// Whether a node may lie there: a finite place within 2^23 voxels of the survey's origin. Beyond it lengths
// could no longer be counted, and no survey is.
bool in_reach(const survey::IndexPoint& p);

// Sorted: first those along the main direction, then those across, each by place. Notes what it changed.
// Throws Error kInvalid for nodes that are not in_reach(), pillars without nodes, equal ids, and pillars
// folded on themselves in the chart.
std::vector<Course> courses_of(std::span<const PillarInput> pillars, const Chart& chart,
                               std::vector<std::string>& notes, const PlaceText& place_text = index_text,
                               const JobContext& job = JobContext());

// The points of two segments p0-p1 and q0-q1 that coincide (within kTouch): none, a crossing or a touch, or
// two ends of an overlap. u and v are their parameters on p and q.
struct Meeting {
  double u = 0, v = 0;
};
struct Meetings {
  int count = 0;
  std::array<Meeting, 4> at;
  void add(double u, double v) {
    if (count < 4) at[static_cast<std::size_t>(count++)] = {u, v};
  }
};
Meetings meetings_of(const ChartPoint& p0, const ChartPoint& p1, const ChartPoint& q0, const ChartPoint& q1);

double chart_distance(const ChartPoint& a, const ChartPoint& b);
double space_distance(const ChartPoint& a, const ChartPoint& b);
ChartPoint between(const ChartPoint& a, const ChartPoint& b, double t);

}  // namespace footwall::pillars
