#include "engine/pillars/ties.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

const Chart kWall{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1}};  // strike = j, dip = k, height = i

std::vector<Course> courses(const std::vector<std::vector<survey::IndexPoint>>& nodes) {
  std::vector<PillarInput> pillars;
  for (const auto& n : nodes)
    pillars.push_back(
        {static_cast<std::int64_t>(pillars.size()) + 1, fmt::format("P{}", pillars.size() + 1), n, {}});
  std::vector<std::string> notes;
  return courses_of(pillars, kWall, notes);
}

TEST(Ties, ThreePillarsThroughOnePlaceAreOneTieAtTheirMean) {
  std::vector<MisTie> mis_ties;
  const auto ties =
      ties_of(courses({{{0, 10, 0}, {0, 10, 20}}, {{1, 0, 10}, {1, 20, 10}}, {{0.5, 5, 0}, {0.5, 15, 20}}}),
              kWall, 2, index_text, mis_ties, JobContext());
  ASSERT_EQ(ties.size(), 1u);
  EXPECT_EQ(ties[0].stops.size(), 3u);
  EXPECT_NEAR(ties[0].point.height, 0.5, 1e-12);
  EXPECT_NEAR(ties[0].point.strike, 10, 1e-12);
  EXPECT_EQ(mis_ties.size(), 3u);
}

TEST(Ties, ToleranceIsInclusive) {
  std::vector<MisTie> mis_ties;
  const auto crossing = courses({{{0, 10, 0}, {0, 10, 20}}, {{2, 0, 10}, {2, 20, 10}}});
  EXPECT_EQ(ties_of(crossing, kWall, 2, index_text, mis_ties, JobContext()).size(), 1u);
  EXPECT_EQ(mis_ties[0].distance, 2);
  EXPECT_THROW(ties_of(crossing, kWall, 1.99, index_text, mis_ties, JobContext()), Error);
}

TEST(Ties, PillarsThatCrossTwiceAreTiedTwice) {
  std::vector<MisTie> mis_ties;
  const auto ties = ties_of(courses({{{0, 10, 0}, {0, 10, 40}}, {{0, 0, 0}, {0, 20, 20}, {0, 0, 40}}}), kWall,
                            2, index_text, mis_ties, JobContext());
  EXPECT_EQ(ties.size(), 2u);
}

TEST(Ties, PartlyCommonCourseIsRefused) {
  std::vector<MisTie> mis_ties;
  EXPECT_THROW(
      ties_of(courses({{{0, 10, 0}, {0, 10, 40}}, {{0, 0, 0}, {0, 10, 10}, {0, 10, 30}, {0, 20, 40}}}), kWall,
              2, index_text, mis_ties, JobContext()),
      Error);
}

TEST(Ties, ApartMeansNone) {
  std::vector<MisTie> mis_ties;
  EXPECT_TRUE(ties_of(courses({{{0, 10, 0}, {0, 10, 40}}, {{0, 20, 0}, {0, 20, 40}}}), kWall, 2, index_text,
                      mis_ties, JobContext())
                  .empty());
  EXPECT_TRUE(mis_ties.empty());
}

TEST(Ties, CanBeCancelled) {
  const JobContext job;
  job.cancel();
  std::vector<MisTie> mis_ties;
  const auto two = courses({{{0, 10, 0}, {0, 10, 40}}, {{0, 20, 0}, {0, 20, 40}}});
  EXPECT_THROW(ties_of(two, kWall, 2, index_text, mis_ties, job), Error);
}

}  // namespace
}  // namespace footwall::pillars
