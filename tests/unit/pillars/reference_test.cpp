#include "engine/pillars/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace footwall::pillars {
namespace {

Course course(std::vector<ChartPoint> points) {
  Course c;
  c.points = std::move(points);
  c.s = {0};
  for (std::size_t n = 1; n < c.points.size(); ++n)
    c.s.push_back(c.s.back() + space_distance(c.points[n - 1], c.points[n]));
  for (double& s : c.s) s = c.s.back() > 0 ? s / c.s.back() : 0;
  return c;
}

TEST(Reference, RuledSurfacePassesThroughItsRulings) {
  const Course a = course({{0, 0, 1}, {1, 20, 6}, {-1, 55, -4}, {0, 90, 3}});
  const Course b = course({{30, 5, 8}, {33, 40, -9}, {29, 95, 2}});
  const auto ruled = ruled_surface(a, b);
  ASSERT_NE(ruled, nullptr);
  std::mt19937 random(9);
  for (int n = 0; n < 2000; ++n) {
    const double s = double(random() % 1001) / 1000, t = double(random() % 1001) / 1000;
    const ChartPoint p = between(a.at(s), b.at(s), t);
    EXPECT_NEAR(ruled->height(p.strike, p.dip), p.height, 1e-9);
  }
  EXPECT_EQ(ruled_surface(b, a), nullptr) << "the wrong way round";
}

// Also where it bends back beside itself, and in any order of the questions.
TEST(Reference, RuledSurfaceOfLongBentCourses) {
  std::mt19937 random(4);
  std::vector<ChartPoint> inner, outer;
  for (int n = 0; n <= 900; ++n) {
    const double angle = n * 5.2 / 900;
    for (auto [course, radius] : {std::pair{&inner, 50.0}, std::pair{&outer, 60.0}})
      course->push_back({radius * std::cos(angle), radius * std::sin(angle), double(random() % 100) / 50});
  }
  outer.erase(outer.begin() + 400, outer.begin() + 600);
  const Course a = course(inner), b = course(outer);
  const auto ruled = ruled_surface(a, b);
  ASSERT_NE(ruled, nullptr);
  for (int n = 0; n < 5000; ++n) {
    const double s = double(random() % 100001) / 100000, t = double(random() % 1001) / 1000;
    const ChartPoint p = between(a.at(s), b.at(s), t);
    EXPECT_NEAR(ruled->height(p.strike, p.dip), p.height, 1e-6);
  }
}

TEST(Reference, RuledSurfaceToASingleNodeIsACone) {
  const Course tip = course({{0, 40, 5}}), b = course({{30, 0, 0}, {30, 50, 10}, {25, 90, 0}});
  const auto ruled = ruled_surface(tip, b);
  ASSERT_NE(ruled, nullptr);
  const ChartPoint p = between(tip.points[0], b.at(0.3), 0.25);
  EXPECT_NEAR(ruled->height(p.strike, p.dip), p.height, 1e-9);
  EXPECT_NEAR(ruled->height(0, 40), 5, 1e-9);
}

TEST(Reference, NoRuledSurfaceWhereLinesOvertakeEachOther) {
  const Course a = course({{0, 0, 0}, {0, 10, 0}, {6, 9, 0}, {6, 20, 0}});
  const Course b = course({{8, 0, 0}, {8, 20, 0}});
  EXPECT_EQ(ruled_surface(a, b), nullptr);
}

TEST(Reference, MeanValuesReproducePlanesAndTheRim) {
  // An L-shaped rim: the corner at (10, 10) points inwards.
  std::vector<ChartPoint> loop{{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {10, 10, 0}, {10, 30, 0}, {0, 30, 0}};
  for (ChartPoint& p : loop) p.height = 2 + 0.3 * p.strike - 0.7 * p.dip;
  const auto plane = mean_value_surface(loop);
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{5, 5}, {25, 5}, {5, 25}, {9.9, 9.9}, {29, 9}})
    EXPECT_NEAR(plane->height(x, y), 2 + 0.3 * x - 0.7 * y, 1e-9);
  loop[3].height += 4;
  const auto bent = mean_value_surface(loop);
  EXPECT_NEAR(bent->height(10, 10), loop[3].height, 1e-9);
  EXPECT_NEAR(bent->height(20, 10), 0.5 * (loop[2].height + loop[3].height), 1e-9);
  EXPECT_NEAR(bent->height(20, 10 - 1e-7), bent->height(20, 10), 1e-5) << "continuous at the rim";
  EXPECT_NEAR(bent->height(10 - 1e-7, 10 - 1e-7), loop[3].height, 1e-5);
  // The same rim in short pieces, from the middle of a side on.
  std::vector<ChartPoint> pieces;
  for (std::size_t n = 0; n < loop.size(); ++n)
    for (int m = 0; m < 7; ++m) pieces.push_back(between(loop[n], loop[(n + 1) % loop.size()], m / 7.0));
  std::rotate(pieces.begin(), pieces.begin() + 3, pieces.end());
  const auto same = mean_value_surface(pieces);
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{5, 5}, {25, 5}, {9, 9.9}, {20, 10}, {1, 29}})
    EXPECT_NEAR(same->height(x, y), bent->height(x, y), 1e-9);
}

}  // namespace
}  // namespace footwall::pillars
