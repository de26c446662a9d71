#include "engine/voxelize/rotated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/verify/raster_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/simd.h"
#include "unit/voxelize/contract.h"
#include "unit/voxelize/triangles.h"

namespace footwall::voxelize {
namespace {

using survey::Box;
using survey::LatticeTriangle;

std::vector<Voxel> visits(RotatedLoop loop, int threads, const LatticeTriangle& t, const Box& box) {
  Rotated rotated(loop, threads);
  std::vector<Voxel> voxels;
  rotated.visits(t, box, voxels);
  return voxels;
}

class RotatedTest : public ::testing::Test {
 protected:
  void TearDown() override { limit_simd(forced_simd()); }
};

TEST_F(RotatedTest, TurnsThePixelsOfTheFormulasIntoVoxels) {
  Numbers numbers(1);
  int compared = 0;
  std::size_t pixels = 0;
  for (int round = 0; round < 40; ++round) {
    for (const Kind kind : kAllKinds) {
      const auto t = make_triangle(kind, 256 * numbers.within(1, 25),
                                   {numbers.within(-9999, 9999), numbers.within(-9999, 9999), -77}, numbers);
      const auto expected = verify::rotated_by_formulas(t);
      if (expected.doubtful) continue;
      ++compared;
      pixels += expected.position.size();
      ASSERT_TRUE(verify::are_rounded(expected, visits(RotatedLoop::kLc, 1, t, kEverywhere), t))
          << text_of(t);
    }
  }
  EXPECT_GT(compared, 250);
  EXPECT_GT(pixels, 20000u);
}

TEST_F(RotatedTest, AllSignsOfOneTripleFollowTheFormulas) {
  int compared = 0;
  for (int signs = 0; signs < 512; ++signs) {
    LatticeTriangle t = {{{15 * 256 + 3, 12 * 256, 5 * 256},
                          {10 * 256, 5 * 256, 2 * 256 + 7},
                          {4 * 256, 3 * 256 + 1, 6 * 256}}};
    int bit = 0;
    for (auto& p : t) {
      for (auto* x : {&p.i, &p.j, &p.k}) {
        if (((signs >> bit++) & 1) != 0) *x = -*x;
      }
    }
    const auto expected = verify::rotated_by_formulas(t);
    const auto voxels = visits(RotatedLoop::kLc, 1, t, kEverywhere);
    ASSERT_EQ(voxels, visits(RotatedLoop::kPlain, 1, t, kEverywhere)) << text_of(t);
    if (expected.doubtful) continue;
    ++compared;
    ASSERT_TRUE(verify::are_rounded(expected, voxels, t)) << text_of(t);
  }
  EXPECT_GT(compared, 480);
}

TEST_F(RotatedTest, BothLoopsAllThreadCountsAndInstructionSetsAgree) {
  Numbers numbers(2);
  for (int round = 0; round < 5; ++round) {
    // Large enough for a team, also when cut by the box.
    const auto t = make_triangle(Kind::kAny, 256 * 300, {0, 0, 0}, numbers);
    const Box box = {{-250, -300, -200}, {300, 250, 300}};
    const auto expected = visits(RotatedLoop::kLc, 1, t, box);
    for (const RotatedLoop loop : {RotatedLoop::kLc, RotatedLoop::kPlain}) {
      for (const int threads : {1, 2, 3, 7}) {
        ASSERT_EQ(visits(loop, threads, t, box), expected) << threads << text_of(t);
      }
    }
    for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      limit_simd(level);
      ASSERT_EQ(visits(RotatedLoop::kLc, 1, t, box), expected) << text_of(t);
    }
    limit_simd(std::nullopt);
  }
}

TEST_F(RotatedTest, KeepsTheContract) {
  Numbers numbers(3);
  Rotated lc(RotatedLoop::kLc);
  Rotated plain(RotatedLoop::kPlain);
  for (int round = 0; round < 90; ++round) {
    const auto t = make_triangle(kAllKinds[round % 9], 9000, {1000, 2000, 3000}, numbers);
    expect_contract(lc, t, numbers);
    if (round < 18) expect_contract(plain, t, numbers);
  }
}

TEST_F(RotatedTest, TheRasterHoldsTheRowsVoxelsInTheOrderOfTheVisits) {
  Numbers numbers(4);
  Rotated rotated;
  bool repeated = false;
  for (int round = 0; round < 20; ++round) {
    const auto t = make_triangle(Kind::kAny, 256 * 30, {0, 0, 0}, numbers);
    std::vector<Voxel> all;
    std::vector<Voxel> raster;
    rotated.visits(t, kEverywhere, all);
    rotated.raster(t, kEverywhere, raster);
    std::set<Voxel> seen;
    std::vector<Voxel> expected;
    for (const Voxel& voxel : all) {
      if (seen.insert(voxel).second) expected.push_back(voxel);
    }
    repeated = repeated || expected.size() < all.size();
    EXPECT_EQ(raster, expected);
    EXPECT_EQ(voxels_of(rotated, t, kEverywhere), std::vector<Voxel>(seen.begin(), seen.end()));
  }
  EXPECT_TRUE(repeated);
}

// The omission that comes with the printed loops: of the lower edge all is there but its ends.
TEST_F(RotatedTest, LeavesOutTwoEdges) {
  const LatticeTriangle t = {{{0, 0, 0}, {5 * 256, 5 * 256, 0}, {10 * 256, 0, 0}}};
  const std::vector<Voxel> expected = {
      {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 0, 0}, {3, 1, 0}, {3, 2, 0}, {4, 0, 0}, {4, 1, 0}, {4, 2, 0},
      {4, 3, 0}, {5, 0, 0}, {5, 1, 0}, {5, 2, 0}, {5, 3, 0}, {5, 4, 0}, {6, 0, 0}, {6, 1, 0}, {6, 2, 0},
      {6, 3, 0}, {7, 0, 0}, {7, 1, 0}, {7, 2, 0}, {8, 0, 0}, {8, 1, 0}, {9, 0, 0}};
  EXPECT_EQ(visits(RotatedLoop::kLc, 1, t, kEverywhere), expected);
}

TEST_F(RotatedTest, HasNothingForTrianglesWithoutAreaOrOutside) {
  Numbers numbers(5);
  for (const Kind kind : {Kind::kSegment, Kind::kPoint}) {
    EXPECT_TRUE(
        visits(RotatedLoop::kLc, 1, make_triangle(kind, 9000, {0, 0, 0}, numbers), kEverywhere).empty());
  }
  const auto t = make_triangle(Kind::kAny, 9000, {0, 0, 0}, numbers);
  EXPECT_TRUE(visits(RotatedLoop::kLc, 1, t, {{500, 0, 0}, {600, 9, 9}}).empty());
  EXPECT_TRUE(visits(RotatedLoop::kLc, 1, t, {}).empty());
}

// Nearly all of its voxels are met by the triangle.
TEST_F(RotatedTest, StaysNearTheTriangle) {
  Numbers numbers(6);
  std::size_t voxels = 0;
  std::size_t extra = 0;
  for (int round = 0; round < 60; ++round) {
    const auto t = make_triangle(Kind::kAny, 256 * 20, {0, 0, 0}, numbers);
    for (const Voxel& voxel : visits(RotatedLoop::kLc, 1, t, kEverywhere)) {
      ++voxels;
      if (!verify::meets(t, {voxel[0], voxel[1], voxel[2]})) ++extra;
    }
  }
  EXPECT_GT(voxels, 5000u);
  EXPECT_LT(static_cast<double>(extra), 0.01 * static_cast<double>(voxels));
}

}  // namespace
}  // namespace footwall::voxelize
