// Where pillars cross or touch in the chart.
#pragma once
#include <vector>

#include "engine/pillars/course.h"
#include "engine/pillars/triangulate.h"

namespace footwall::pillars {

// One place where two or more courses meet.
struct Tie {
  ChartPoint point;                                    // half-way between the courses in height
  std::vector<std::pair<std::int32_t, double>> stops;  // course and distance along it in the chart, by course
};

// Distance along a course in the chart, at each of its nodes.
std::vector<double> chart_lengths(const Course& course);

// Ordered by their courses and places. Adds every pair to mis_ties. Throws Error kInvalid naming the pillars
// that cross with more than `tolerance` voxels between them or lie on one another.
std::vector<Tie> ties_of(const std::vector<Course>& courses, const Chart& chart, double tolerance,
                         const PlaceText& place_text, std::vector<MisTie>& mis_ties, const JobContext& job);

}  // namespace footwall::pillars
