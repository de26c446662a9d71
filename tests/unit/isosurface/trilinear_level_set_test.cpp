#include "engine/verify/trilinear_level_set.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace footwall::verify {
namespace {

// The parts on n^3 samples of the cell, its corners among them: what the halving must find where nothing is
// finer than a sample.
int parts_by_flooding(const std::array<double, 8>& v, int n, bool inside) {
  const auto value = [&](int x, int y, int z) {
    const double t[3] = {x / (n - 1.0), y / (n - 1.0), z / (n - 1.0)};
    double sum = 0;
    for (int c = 0; c < 8; ++c)
      sum += v[c] * ((c & 1) != 0 ? t[0] : 1 - t[0]) * ((c & 2) != 0 ? t[1] : 1 - t[1]) *
             ((c & 4) != 0 ? t[2] : 1 - t[2]);
    return sum;
  };
  std::vector<bool> open(static_cast<std::size_t>(n * n * n));
  const auto at = [&](int x, int y, int z) { return static_cast<std::size_t>(x + n * (y + n * z)); };
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) open[at(x, y, z)] = (value(x, y, z) >= 0) == inside;
    }
  }
  int parts = 0;
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (!open[start]) continue;
    ++parts;
    std::vector<std::size_t> left{start};
    open[start] = false;
    while (!left.empty()) {
      const std::size_t place = left.back();
      left.pop_back();
      const int x = static_cast<int>(place) % n;
      const int y = static_cast<int>(place) / n % n;
      const int z = static_cast<int>(place) / n / n;
      const int steps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
      for (const auto& step : steps) {
        const int a = x + step[0];
        const int b = y + step[1];
        const int c = z + step[2];
        if (a < 0 || b < 0 || c < 0 || a >= n || b >= n || c >= n || !open[at(a, b, c)]) continue;
        open[at(a, b, c)] = false;
        left.push_back(at(a, b, c));
      }
    }
  }
  return parts;
}

TEST(TrilinearLevelSet, KnowsTheSimplestForms) {
  EXPECT_EQ(trilinear_level_set({1, 1, 1, 1, 1, 1, 1, 1}), (LevelSet{0, 1, 0}));
  EXPECT_EQ(trilinear_level_set({-1, -1, -1, -1, -1, -1, -1, -1}), (LevelSet{0, 0, 1}));
  EXPECT_EQ(trilinear_level_set({1, 1, 1, 1, -1, -1, -1, -1}), (LevelSet{1, 1, 1}));
  EXPECT_EQ(trilinear_level_set({5, -100, -100, -100, -100, -100, -100, 5}), (LevelSet{2, 2, 1}));
  EXPECT_EQ(trilinear_level_set({100, -1, -1, -1, -1, -1, -1, 100}), (LevelSet{0, 1, 1}));
  EXPECT_EQ(trilinear_level_set({0, -1, -1, -1, -1, -1, -1, -1}), (LevelSet{1, 1, 1}));
}

TEST(TrilinearLevelSet, PartsAreThoseThatFloodingFinds) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> value(-50, 50);
  int compared = 0;
  for (int round = 0; round < 60; ++round) {
    std::array<double, 8> v{};
    for (double& each : v) each = value(random);
    const auto exact = trilinear_level_set(v);
    ASSERT_TRUE(exact);
    for (const bool inside : {true, false}) {
      const int coarse = parts_by_flooding(v, 21, inside);
      if (coarse != parts_by_flooding(v, 34, inside)) continue;  // finer than a sample
      ++compared;
      EXPECT_EQ(coarse, inside ? exact->inside : exact->outside) << round;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(TrilinearLevelSet, AClosedSurfaceInAGridHasTheEulerNumberOfASphere) {
  std::vector<double> ball(125, -1);
  ball[62] = 1;
  EXPECT_EQ(grid_euler_number(ball, 5), 2);
  ball[62 + 1] = 1;
  EXPECT_EQ(grid_euler_number(ball, 5), 2);
  // A ring of eight samples around the middle of the layer: a torus.
  for (int n = 0; n < 9; ++n) ball[static_cast<std::size_t>(50 + 6 + n % 3 + 5 * (n / 3))] = n == 4 ? -9 : 1;
  EXPECT_EQ(grid_euler_number(ball, 5), 0);
}

}  // namespace
}  // namespace footwall::verify
