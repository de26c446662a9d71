#include "engine/pillars/course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "storage/base/error.h"
#include "unit/pillars/true_surface.h"

namespace footwall::pillars {
namespace {

using namespace testing;

TEST(Course, RunsWithTheChartWhateverTheDirectionOfPicking) {
  auto pillars = picked(planar, 4, 5, 20);
  const Chart chart = fit_chart(pillars);
  std::reverse(pillars[2].nodes.begin(), pillars[2].nodes.end());
  std::vector<std::string> notes;
  const auto courses = courses_of(pillars, chart, notes);
  ASSERT_EQ(courses.size(), 4u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("'P3'"), std::string::npos);
  for (const Course& c : courses) {
    EXPECT_FALSE(c.crosses);
    EXPECT_LT(c.positions.front().k, c.positions.back().k);
    EXPECT_EQ(c.s.front(), 0);
    EXPECT_EQ(c.s.back(), 1);
    EXPECT_LT(chart_distance(c.at(0.25), c.points[1]), 1e-9) << "evenly spaced nodes of a straight pillar";
  }
  for (std::size_t n = 1; n < courses.size(); ++n) EXPECT_LT(courses[n - 1].place, courses[n].place);
}

TEST(Course, SlicesCrossAndComeLast) {
  auto pillars = picked(planar, 4, 5, 20);
  pillars.insert(pillars.begin(), slice(planar, 11, 40, 0, 80, 5));
  std::vector<std::string> notes;
  const auto courses = courses_of(pillars, fit_chart(pillars), notes);
  EXPECT_TRUE(courses.back().crosses);
  EXPECT_EQ(courses.back().id, 11);
}

TEST(Course, NodesAndChartsThatAreFarAwayAreRefused) {
  const auto near = picked(planar, 4, 5, 20);
  const Chart chart = fit_chart(near);
  std::vector<std::string> notes;
  for (const double far :
       {1e10, -1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    auto pillars = near;
    pillars[1].nodes[2].k = far;
    EXPECT_THROW(fit_chart(pillars), Error) << far;
    EXPECT_THROW(courses_of(pillars, chart, notes), Error) << far;
  }
  // As a damaged project may have it: finite, and no frame.
  Chart stretched = chart;
  for (double& part : stretched.dip) part *= 1e200;
  EXPECT_THROW(courses_of(near, stretched, notes), Error);
  auto edge = near;
  edge[1].nodes[2].k = 1 << 23;
  EXPECT_NO_THROW(fit_chart(edge));
}

TEST(Course, CanBeCancelled) {
  const auto pillars = picked(planar, 4, 5, 20);
  const JobContext job;
  job.cancel();
  std::vector<std::string> notes;
  EXPECT_THROW(courses_of(pillars, fit_chart(pillars), notes, index_text, job), Error);
}

TEST(Course, MeetingsAreFoundWithinOneLatticeStep) {
  const ChartPoint a{0, 0, 0}, b{10, 0, 0};
  EXPECT_EQ(meetings_of(a, b, {5, -5, 0}, {5, 5, 0}).count, 1);
  EXPECT_NEAR(meetings_of(a, b, {5, -5, 0}, {5, 5, 0}).at[0].u, 0.5, 1e-12);
  EXPECT_EQ(meetings_of(a, b, {5, 0.9 * kTouch, 0}, {5, 5, 0}).count, 1);
  EXPECT_EQ(meetings_of(a, b, {5, 1.1 * kTouch, 0}, {5, 5, 0}).count, 0);
  EXPECT_EQ(meetings_of(a, b, {11, -5, 0}, {11, 5, 0}).count, 0);
  EXPECT_GE(meetings_of(a, b, {4, 0, 0}, {20, 0, 0}).count, 2) << "an overlap has two ends";
}

}  // namespace
}  // namespace footwall::pillars
