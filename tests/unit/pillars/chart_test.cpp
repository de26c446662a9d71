#include "engine/pillars/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "storage/base/error.h"
#include "unit/pillars/true_surface.h"

namespace footwall::pillars {
namespace {

using namespace testing;

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TEST(Chart, FindsThePlaneOfAPlanarFault) {
  const Chart c = fit_chart(picked(planar, 6, 5, 10));
  const double length = std::sqrt(1 + 0.09 + 0.36);
  EXPECT_NEAR(c.normal[0], 1 / length, 1e-9);
  EXPECT_NEAR(c.normal[1], -0.3 / length, 1e-9);
  EXPECT_NEAR(c.normal[2], -0.6 / length, 1e-9);
  EXPECT_EQ(c.strike[2], 0);
  EXPECT_GT(c.dip[2], 0);
  EXPECT_NEAR(dot(c.strike, c.dip), 0, 1e-12);
  EXPECT_NEAR(dot(c.strike, c.normal), 0, 1e-12);
  EXPECT_GT(std::abs(c.along[1]), 0.7);
  for (const PillarInput& p : picked(planar, 6, 5, 10))
    for (const auto& n : p.nodes) EXPECT_NEAR(c.from_index(n).height, 0, 1e-9);
}

TEST(Chart, MapsThereAndBack) {
  const Chart c = fit_chart(picked(twisted, 6, 5, 10, 2));
  for (const PillarInput& p : picked(twisted, 6, 5, 10, 2)) {
    for (const auto& n : p.nodes) {
      const auto back = c.to_index(c.from_index(n));
      EXPECT_NEAR(back.i, n.i, 1e-9);
      EXPECT_NEAR(back.j, n.j, 1e-9);
      EXPECT_NEAR(back.k, n.k, 1e-9);
    }
  }
}

TEST(Chart, TextKeepsEveryBit) {
  const Chart c = fit_chart(picked(listric, 6, 5, 10, 1));
  EXPECT_EQ(Chart::from_text(c.to_text()), c);
  EXPECT_EQ(Chart::from_text(Chart().to_text()), Chart());
  EXPECT_TRUE(Chart().empty());
  EXPECT_FALSE(c.empty());
}

TEST(Chart, RefusesTextThatIsNoFrame) {
  Chart skew = fit_chart(picked(listric, 6, 5, 10, 1));
  skew.dip[0] += 0.1;
  Chart infinite = skew;
  infinite.origin[1] = std::numeric_limits<double>::infinity();
  for (const std::string& text :
       {std::string(), std::string("chart1 1 2 3"), skew.to_text(), infinite.to_text(),
        fit_chart(picked(listric, 6, 5, 10)).to_text().substr(1)})
    EXPECT_THROW(Chart::from_text(text), Error) << text;
}

TEST(Chart, OrderOfPillarsLeavesNoTrace) {
  auto pillars = picked(twisted, 9, 5, 10, 2);
  const Chart c = fit_chart(pillars);
  std::reverse(pillars.begin(), pillars.end());
  EXPECT_EQ(fit_chart(pillars), c);
}

TEST(Chart, AxisAlignedPlanesHaveCleanNormals) {
  const std::vector<PillarInput> wall{{1, "a", {{0, 7, 0}, {0.1, 7, 50}}, {}},
                                      {2, "b", {{40, 7, 0}, {40, 7, 60.3}}, {}}};
  EXPECT_EQ(fit_chart(wall).normal, (Vector3{0, 1, 0}));
  const std::vector<PillarInput> floor{{1, "a", {{0, 0, 7}, {0, 50, 7}}, {}},
                                       {2, "b", {{40, 1, 7}, {40, 60, 7}}, {}}};
  EXPECT_EQ(fit_chart(floor).normal, (Vector3{0, 0, 1}));
}

TEST(Chart, TellsTwoEquallyStrongFamiliesApart) {
  std::vector<PillarInput> pillars;
  for (int n = 0; n < 3; ++n) {
    pillars.push_back({n + 1, "down", {{0, 20.0 * n, -10}, {0, 20.0 * n + 1, 50}}, {}});
    pillars.push_back({n + 11, "level", {{0, -10, 20.0 * n}, {0, 50, 20.0 * n}}, {}});
  }
  const Chart c = fit_chart(pillars);
  EXPECT_GT(std::max(std::abs(c.along[0]), std::abs(c.along[1])), 0.99);
}

}  // namespace
}  // namespace footwall::pillars
