#include "engine/isosurface/visible/passes.h"

#include <gtest/gtest.h>

namespace footwall::isosurface {
namespace {

TEST(Passes, LoadDifferenceIsOverTheRanksThatGotCells) {
  EXPECT_NEAR(load_difference({2, 3, 0}, {90, 110, 0}), 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(load_difference({1, 1, 1}, {100, 100, 100}), 0);
  EXPECT_DOUBLE_EQ(load_difference({0, 4, 0}, {0, 100, 0}), 0);
  EXPECT_DOUBLE_EQ(load_difference({0, 0}, {0, 0}), 0);
  EXPECT_DOUBLE_EQ(load_difference({1, 1}, {0, 0}), 0);
}

TEST(Passes, SumsAreOfAllPassesSoFar) {
  VisibleReport report;
  report.passes.resize(3);
  report.passes[0].triangles = 60;
  report.passes[1].triangles = 30;
  report.passes[2].triangles = 10;
  report.sum_up();
  EXPECT_EQ(report.triangles, 100);
  EXPECT_DOUBLE_EQ(report.passes[0].percent, 60);
  EXPECT_DOUBLE_EQ(report.passes[1].percent, 90);
  EXPECT_DOUBLE_EQ(report.passes[2].percent, 100);
}

}  // namespace
}  // namespace footwall::isosurface
