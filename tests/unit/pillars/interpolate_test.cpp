#include "engine/pillars/interpolate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/pillars/triangulate.h"
#include "storage/base/error.h"
#include "unit/pillars/true_surface.h"

namespace footwall::pillars {
namespace {

using survey::IndexPoint;
using namespace testing;

Interpolation every(const std::vector<PillarInput>& picked, double lines) {
  return interpolate(picked, {.every_lines = lines}, std::nullopt, JobContext());
}

double bowl(double j, double k) {
  return 40 + 0.01 * (j - 70) * (j - 70) + 0.2 * k;
}

TEST(Interpolate, EveryFifthLineBetweenCrosslinesTwentyApart) {
  const auto pillars = picked(planar, 4, 6, 20);
  const Interpolation r = every(pillars, 5);
  ASSERT_EQ(r.pillars.size(), 9u);
  EXPECT_EQ(r.pillars[0].parents.a + r.pillars[0].parents.b, r.pillars[2].parents.a + r.pillars[2].parents.b);
  for (const InterpolatedPillar& p : r.pillars) {
    EXPECT_GT(p.parents.parameter, 0);
    EXPECT_LT(p.parents.parameter, 1);
    ASSERT_EQ(p.nodes.size(), 6u);
    const double j_a = 10 + 20.0 * double(p.parents.a - 1), j_b = 10 + 20.0 * double(p.parents.b - 1);
    for (const IndexPoint& n : p.nodes) {
      EXPECT_NEAR(n.j, j_a + p.parents.parameter * (j_b - j_a), 1e-6);
      EXPECT_NEAR(n.i, planar(n.j, n.k), 1e-6);
    }
  }
}

TEST(Interpolate, FollowsABentFaultBetterThanStraightLines) {
  const auto pillars = picked(bowl, 7, 8, 20);
  double plate = 0, straight = 0;
  for (const InterpolatedPillar& p : every(pillars, 10).pillars) {
    // The plate flattens out in the outermost panels, which know one side only.
    if (std::min(p.parents.a, p.parents.b) == 1 || std::max(p.parents.a, p.parents.b) == 7) continue;
    const auto &a = pillars[p.parents.a - 1], &b = pillars[p.parents.b - 1];
    for (std::size_t n = 0; n < p.nodes.size(); ++n) {
      plate = std::max(plate, std::abs(p.nodes[n].i - bowl(p.nodes[n].j, p.nodes[n].k)));
      const double j = 0.5 * (a.nodes[n].j + b.nodes[n].j), k = a.nodes[n].k;
      straight = std::max(straight, std::abs(0.5 * (a.nodes[n].i + b.nodes[n].i) - bowl(j, k)));
    }
  }
  EXPECT_NEAR(straight, 1, 0.05);
  EXPECT_LT(plate, 0.5 * straight);
}

TEST(Interpolate, ToleranceInsertsOnlyWhereItBends) {
  EXPECT_TRUE(
      interpolate(picked(planar, 5, 6, 20), {.tolerance = 0.1}, std::nullopt, JobContext()).pillars.empty());
  const auto pillars = picked(bowl, 7, 8, 20);
  const auto loose = interpolate(pillars, {.tolerance = 0.5}, std::nullopt, JobContext()).pillars.size();
  const auto tight = interpolate(pillars, {.tolerance = 0.05}, std::nullopt, JobContext()).pillars.size();
  EXPECT_GT(loose, 0u);
  EXPECT_GT(tight, loose);
}

TEST(Interpolate, StaysWithinOneSpacing) {
  auto pillars = picked(planar, 4, 6, 4);
  for (auto& n : pillars[0].nodes) n.i += 40;  // a cliff makes the plate swing
  for (const InterpolatedPillar& p : every(pillars, 1).pillars) {
    const auto &a = pillars[p.parents.a - 1], &b = pillars[p.parents.b - 1];
    for (std::size_t n = 0; n < p.nodes.size(); ++n) {
      const double spacing = std::abs(a.nodes[n].i - b.nodes[n].i) + 4;
      const double low = std::min(a.nodes[n].i, b.nodes[n].i), high = std::max(a.nodes[n].i, b.nodes[n].i);
      EXPECT_GT(p.nodes[n].i, low - spacing - 1);
      EXPECT_LT(p.nodes[n].i, high + spacing + 1);
    }
  }
}

TEST(Interpolate, RegeneratesTheSameBitsAndFollowsAMovedParent) {
  auto pillars = picked(twisted, 5, 6, 20, 1);
  const Chart chart = fit_chart(pillars);
  const InterpolateOptions options{.every_lines = 6};
  const Interpolation first = interpolate(pillars, options, chart, JobContext());
  std::vector<Parents> parents;
  for (const InterpolatedPillar& p : first.pillars) parents.push_back(p.parents);
  const Interpolation again = regenerate(pillars, parents, options, chart, JobContext());
  ASSERT_EQ(again.pillars.size(), first.pillars.size());
  for (std::size_t n = 0; n < parents.size(); ++n) EXPECT_EQ(again.pillars[n].nodes, first.pillars[n].nodes);

  for (auto& node : pillars[1].nodes) node.i += 5;
  const Interpolation moved = regenerate(pillars, parents, options, chart, JobContext());
  for (std::size_t n = 0; n < parents.size(); ++n) {
    if (parents[n].a != 2 && parents[n].b != 2) continue;
    EXPECT_NE(moved.pillars[n].nodes, first.pillars[n].nodes);
  }
  EXPECT_THROW(regenerate(pillars, std::vector<Parents>{{1, 77, 0.5}}, options, chart, JobContext()), Error);
}

TEST(Interpolate, OrderOfPickingLeavesNoTrace) {
  auto pillars = picked(twisted, 5, 6, 20, 1);
  const Interpolation straight = every(pillars, 7);
  std::reverse(pillars.begin(), pillars.end());
  const Interpolation reversed = every(pillars, 7);
  ASSERT_EQ(straight.pillars.size(), reversed.pillars.size());
  for (std::size_t n = 0; n < straight.pillars.size(); ++n)
    EXPECT_EQ(straight.pillars[n].nodes, reversed.pillars[n].nodes);
}

TEST(Interpolate, TimeSlicesCountSamples) {
  std::vector<PillarInput> pillars;
  for (int n = 0; n < 3; ++n) pillars.push_back(slice(planar, n + 1, 10 + 20 * n, 5, 100, 6));
  EXPECT_EQ(every(pillars, 10).pillars.size(), 2u);
}

TEST(Interpolate, ResultTriangulates) {
  auto pillars = picked(bowl, 5, 6, 20, 0.5);
  const auto inserted = every(pillars, 5).pillars;
  for (const InterpolatedPillar& p : inserted)
    pillars.push_back({static_cast<std::int64_t>(pillars.size()) + 100, "inserted", p.nodes, {}});
  const FaultMesh m = triangulate(pillars, {}, std::nullopt, JobContext());
  EXPECT_EQ(m.panels.size(), pillars.size() - 1);
}

TEST(Interpolate, ThinsManyNodesAndSaysSo) {
  const Interpolation r = every(picked(bowl, 60, 40, 3), 2);
  EXPECT_EQ(r.pillars.size(), 59u);
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("2000 of 2400"), std::string::npos);
}

TEST(Interpolate, RefusesNonsense) {
  const auto pillars = picked(planar, 3, 4, 10);
  const auto run = [&](const std::vector<PillarInput>& p, const InterpolateOptions& o) {
    interpolate(p, o, std::nullopt, JobContext());
  };
  EXPECT_THROW(run(pillars, {}), Error);
  EXPECT_THROW(run(pillars, {.every_lines = 5, .tolerance = 1}), Error);
  EXPECT_THROW(run(pillars, {.every_lines = 0}), Error);
  EXPECT_THROW(run(pillars, {.tolerance = std::nan("")}), Error);
  EXPECT_THROW(run(pillars, {.every_lines = 1e-9}), Error);
  EXPECT_THROW(run(pillars, {.every_lines = 5, .smoothing = -1}), Error);
  EXPECT_THROW(run(picked(planar, 1, 4, 10), {.every_lines = 5}), Error);
  EXPECT_THROW(run(picked(planar, 4, 1, 10), {.every_lines = 5}), Error);
}

}  // namespace
}  // namespace footwall::pillars
