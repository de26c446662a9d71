#include "engine/pillars/thin_plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

std::vector<PlateNode> scattered(int count, double (*height)(double, double)) {
  std::mt19937 random(2);
  std::vector<PlateNode> nodes;
  for (int n = 0; n < count; ++n) {
    const double x = double(random() % 100000) / 500, y = double(random() % 100000) / 1000;
    nodes.push_back({x, y, height(x, y)});
  }
  return nodes;
}

TEST(ThinPlate, LogarithmIsTheLogarithm) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 100000; ++n) {
    const double x = std::ldexp(1 + double(random() >> 11) * 0x1p-53, static_cast<int>(random() % 600) - 300);
    EXPECT_NEAR(portable_log(x), std::log(x), 4e-16 * std::max(1.0, std::abs(std::log(x))));
  }
  EXPECT_EQ(portable_log(1), 0);
  EXPECT_THROW(portable_log(0), Error);
}

TEST(ThinPlate, PassesThroughItsNodes) {
  const auto nodes = scattered(300, [](double x, double y) { return 0.01 * x * y - 0.002 * x * x; });
  const ThinPlate plate(nodes, 0, JobContext());
  for (const PlateNode& n : nodes) EXPECT_NEAR(plate.height(n.x, n.y), n.height, 1e-8);
}

TEST(ThinPlate, IsExactForPlanesAndCloseForSmoothSurfaces) {
  const ThinPlate flat(scattered(40, [](double x, double y) { return 3 + 0.5 * x - 0.25 * y; }), 0,
                       JobContext());
  EXPECT_NEAR(flat.height(300, -50), 3 + 150 + 12.5, 1e-8);
  const ThinPlate bowl(
      scattered(400, [](double x, double y) { return 0.004 * (x - 100) * (x - 100) + 0.01 * y * y; }), 0,
      JobContext());
  EXPECT_NEAR(bowl.height(101, 51), 0.004 + 26.01, 0.1);
}

TEST(ThinPlate, SmoothingTakesOutNoise) {
  std::mt19937 random(4);
  auto nodes = scattered(400, [](double x, double) { return 0.1 * x; });
  for (PlateNode& n : nodes) n.height += double(random() % 2001) / 1000 - 1;
  const ThinPlate rough(nodes, 0, JobContext()), smooth(nodes, 1, JobContext());
  double rough_error = 0, smooth_error = 0;
  for (double x = 20; x < 180; x += 7) {
    for (double y = 20; y < 80; y += 7) {
      rough_error += std::abs(rough.height(x, y) - 0.1 * x);
      smooth_error += std::abs(smooth.height(x, y) - 0.1 * x);
    }
  }
  EXPECT_LT(smooth_error, 0.5 * rough_error);
}

TEST(ThinPlate, MergesNodesAtOnePlaceAndRefusesLines) {
  std::vector<PlateNode> nodes{{0, 0, 1}, {0, 0, 3}, {1, 0, 2}, {0, 1, 2}};
  EXPECT_NEAR(ThinPlate(nodes, 0, JobContext()).height(0, 0), 2, 1e-12);
  std::vector<PlateNode> line;
  for (int n = 0; n < 9; ++n) line.push_back({double(n), 2.0 * n, 1});
  EXPECT_THROW(ThinPlate(line, 0, JobContext()), Error);
  EXPECT_THROW(ThinPlate(std::span(nodes).first(2), 0, JobContext()), Error);
}

TEST(ThinPlate, TwoThousandNodes) {
  const auto nodes = scattered(2000, [](double x, double y) { return 0.001 * x * y; });
  const ThinPlate plate(nodes, 0, JobContext());
  EXPECT_NEAR(plate.height(100, 50), 5, 1e-3);
}

}  // namespace
}  // namespace footwall::pillars
