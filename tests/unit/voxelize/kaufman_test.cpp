#include "engine/voxelize/kaufman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/verify/raster_by_definition.h"
#include "unit/voxelize/contract.h"
#include "unit/voxelize/triangles.h"

namespace footwall::voxelize {
namespace {

using survey::Box;
using survey::LatticeTriangle;

std::vector<Voxel> by_definition(const LatticeTriangle& t, const Box& box) {
  std::vector<Voxel> voxels;
  for (const survey::Index& at : verify::kaufman_by_definition(t, box)) {
    voxels.push_back({static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]),
                      static_cast<std::int32_t>(at[2])});
  }
  return voxels;
}

bool is_flat(Kind kind) {
  return kind != Kind::kSegment && kind != Kind::kPoint;
}

bool has_area(const LatticeTriangle& t) {
  const auto cross = [&](std::int32_t survey::LatticePoint::*a, std::int32_t survey::LatticePoint::*b) {
    return (std::int64_t{t[1].*a} - t[0].*a) * (std::int64_t{t[2].*b} - t[0].*b) -
           (std::int64_t{t[1].*b} - t[0].*b) * (std::int64_t{t[2].*a} - t[0].*a);
  };
  using P = survey::LatticePoint;
  return cross(&P::i, &P::j) != 0 || cross(&P::j, &P::k) != 0 || cross(&P::k, &P::i) != 0;
}

TEST(Kaufman, EqualsTheDefinition) {
  Numbers numbers(1);
  Kaufman kaufman;
  int compared = 0;
  for (int round = 0; round < 40; ++round) {
    for (const Kind kind : kAllKinds) {
      const auto t =
          make_triangle(kind, 256 * numbers.within(1, 7), {numbers.within(-9999, 9999), 0, -77}, numbers);
      if (!is_flat(kind) || !has_area(t)) continue;
      ++compared;
      const Box box = survey::grown(bounding_voxels(t), 1);
      ASSERT_EQ(voxels_of(kaufman, t, box), by_definition(t, box)) << text_of(t);
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Kaufman, KeepsTheContract) {
  Numbers numbers(2);
  Kaufman kaufman;
  for (int round = 0; round < 180; ++round) {
    expect_contract(kaufman, make_triangle(kAllKinds[round % 9], 9000, {1000, 2000, 3000}, numbers), numbers);
  }
}

TEST(Kaufman, DrawsALineForATriangleWithoutArea) {
  Kaufman kaufman;
  const LatticeTriangle segment = {{{0, 0, 0}, {4 * 256, -2 * 256, 256}, {2 * 256, -256, 128}}};
  const std::vector<Voxel> line = {{0, 0, 0}, {1, 0, 0}, {2, -1, 0}, {3, -1, 1}, {4, -2, 1}};
  EXPECT_EQ(voxels_of(kaufman, segment, kEverywhere), line);
  const LatticeTriangle point = {{{300, 0, 0}, {300, 0, 0}, {300, 0, 0}}};
  EXPECT_EQ(voxels_of(kaufman, point, kEverywhere), (std::vector<Voxel>{{1, 0, 0}}));
}

// Wider than 64 bits can say exactly.
TEST(Kaufman, HugeTrianglesAreRightInASmallBox) {
  Kaufman kaufman;
  const std::int32_t far = std::numeric_limits<std::int32_t>::max() - 127;
  const LatticeTriangle t = {{{-far, -far, -far + 5000}, {far, -far, -far / 3}, {far - 77, far, far}}};
  const Box all = kEverywhere;
  const Box column = {{4000000, -3000000, all.lo[2]}, {4000003, -2999997, all.hi[2]}};
  std::vector<Voxel> voxels;
  kaufman.raster(t, {{4000000, -3000000, -8000000}, {4000003, -2999997, 8000000}}, voxels);
  EXPECT_EQ(voxels.size(), 9u);
  for (const Voxel& voxel : voxels) EXPECT_TRUE(column.contains({voxel[0], voxel[1], voxel[2]}));
}

TEST(Kaufman, HasNothingOutside) {
  Numbers numbers(5);
  Kaufman kaufman;
  const auto t = make_triangle(Kind::kAny, 9000, {0, 0, 0}, numbers);
  EXPECT_TRUE(voxels_of(kaufman, t, {{500, 0, 0}, {600, 9, 9}}).empty());
  EXPECT_TRUE(voxels_of(kaufman, t, {}).empty());
}

}  // namespace
}  // namespace footwall::voxelize
