#include "engine/pillars/planar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

const std::vector<ChartPoint> kSquare{{0, 0, 0},  {10, 0, 0}, {10, 10, 0}, {0, 10, 0},
                                      {20, 5, 0}, {3, 5, 0},  {6, 2, 0}};

TEST(Planar, FindsTheRegionsThatEdgesEnclose) {
  // A square with a diagonal, an edge that sticks out, one that sticks in, and a lone point.
  const std::vector<PointEdge> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {2, 4}, {3, 5}};
  const auto regions = regions_of(kSquare, edges, std::vector<std::int32_t>{6}, JobContext());
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions[0].rim, (std::vector<PointEdge>{{0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(regions[1].rim, (std::vector<PointEdge>{{0, 2}, {2, 3}, {3, 0}}));
  EXPECT_EQ(regions[1].inner, (std::vector<PointEdge>{{3, 5}}));
  EXPECT_TRUE(regions[0].inner.empty());
  EXPECT_EQ(regions[0].points, (std::vector<std::int32_t>{6}));
}

TEST(Planar, OpenEdgesEncloseNothing) {
  EXPECT_TRUE(regions_of(kSquare, std::vector<PointEdge>{{0, 1}, {1, 2}, {2, 3}}, {}, JobContext()).empty());
  EXPECT_TRUE(regions_of(kSquare, {}, {}, JobContext()).empty());
}

TEST(Planar, RefusesEdgesThatCrossAndPointsThatCoincide) {
  EXPECT_THROW(regions_of(kSquare, std::vector<PointEdge>{{0, 2}, {1, 3}}, {}, JobContext()), Error);
  const std::vector<ChartPoint> twins{{0, 0, 0}, {1, 0, 0}, {0, 0, 5}};
  EXPECT_THROW(regions_of(twins, std::vector<PointEdge>{{0, 1}, {1, 2}}, {}, JobContext()), Error);
  const std::vector<ChartPoint> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  EXPECT_THROW(regions_of(line, std::vector<PointEdge>{{0, 2}, {2, 3}, {3, 0}, {1, 3}}, {}, JobContext()),
               Error);
}

class Bump : public Reference {
 public:
  double height(double x, double y) override { return 0.04 * x * (10 - x) * y * (10 - y) / 25; }
};

TEST(Planar, FillsARegionWithinItsBounds) {
  const std::vector<PointEdge> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto regions = regions_of(kSquare, edges, {}, JobContext());
  ASSERT_EQ(regions.size(), 1u);
  Bump bump;
  const Filling coarse =
      fill_region(regions[0], kSquare, nullptr, {.detail = 0.1, .max_edge = 100}, JobContext());
  EXPECT_EQ(coarse.faces.size(), 2u);
  const Filling fine =
      fill_region(regions[0], kSquare, &bump, {.detail = 0.02, .max_edge = 100}, JobContext());
  EXPECT_GT(fine.added.size(), 5u);
  double area = 0;
  for (const auto& f : fine.faces) {
    ChartPoint p[3];
    for (int k = 0; k < 3; ++k) {
      const auto number = static_cast<std::size_t>(f[static_cast<std::size_t>(k)]);
      p[k] = number < kSquare.size() ? kSquare[number] : fine.added[number - kSquare.size()];
    }
    area += 0.5 * ((p[1].strike - p[0].strike) * (p[2].dip - p[0].dip) -
                   (p[1].dip - p[0].dip) * (p[2].strike - p[0].strike));
    for (int i = 1; i < 30; ++i) {
      for (int j = 1; i + j < 30; ++j) {
        const double a = i / 30.0, b = j / 30.0, c = 1 - a - b;
        const double x = a * p[0].strike + b * p[1].strike + c * p[2].strike;
        const double y = a * p[0].dip + b * p[1].dip + c * p[2].dip;
        EXPECT_NEAR(a * p[0].height + b * p[1].height + c * p[2].height, bump.height(x, y), 0.02);
      }
    }
  }
  EXPECT_NEAR(area, 100, 1e-9);
  EXPECT_THROW(fill_region(regions[0], kSquare, &bump, {.detail = 0.001, .max_edge = 100, .most_points = 50},
                           JobContext()),
               Error);
}

TEST(Planar, CanBeCancelledInEachOfItsSteps) {
  const std::vector<PointEdge> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto regions = regions_of(kSquare, edges, {}, JobContext());
  const JobContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(regions_of(kSquare, edges, {}, cancelled), Error);
  EXPECT_THROW(fill_region(regions[0], kSquare, nullptr, {.detail = 0.1, .max_edge = 100}, cancelled), Error);
}

}  // namespace
}  // namespace footwall::pillars
