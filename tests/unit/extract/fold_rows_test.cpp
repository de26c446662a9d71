#include "engine/extract/fold_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/extract/block.h"
#include "engine/verify/statistics_by_definition.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "unit/voxelize/triangles.h"

namespace footwall::extract {
namespace {

using survey::Box;
using survey::Index;
using voxelize::Voxel;

constexpr Index kDims = {40, 30, 50};
constexpr Box kSurvey = {{0, 0, 0}, kDims};

float value_of(const Index& p) {
  const auto n = static_cast<int>((p[0] * 131 + p[1] * 71 + p[2] * 17) % 1009);
  return n == 500 ? std::nanf("") : static_cast<float>(n - 400) * 0.37F;
}

Block made_block(const Box& own) {
  Block block(own, kDims);
  const Box wanted = block.wanted();
  std::vector<float> values;
  for (std::int64_t i = wanted.lo[0]; i < wanted.hi[0]; ++i) {
    for (std::int64_t j = wanted.lo[1]; j < wanted.hi[1]; ++j) {
      for (std::int64_t k = wanted.lo[2]; k < wanted.hi[2]; ++k) values.push_back(value_of({i, j, k}));
    }
  }
  block.put(wanted, values);
  return block;
}

class FoldRows : public ::testing::Test {
 protected:
  void TearDown() override { voxelize::limit_simd(forced_simd()); }

  void expect_definition(const survey::LatticeTriangle& triangle, std::string_view method) {
    const auto voxelizer = voxelize::make_voxelizer(method);
    std::vector<Voxel> listed;
    voxelizer->raster(triangle, kSurvey, listed);
    std::vector<Index> voxels;
    for (const Voxel& voxel : listed) voxels.push_back({voxel[0], voxel[1], voxel[2]});
    constexpr double kMaxAbs = 300;
    const FaceStatistics expected =
        verify::statistics_by_definition(voxels, kDims, value_of, kMaxAbs, Outside::kInside);
    for (const bool with_discontinuity : {false, true}) {
      // Two blocks, whose partial sums add up.
      Partial sum;
      for (const Box& own : {Box{{0, 0, 0}, {17, 30, 50}}, Box{{17, 0, 0}, kDims}}) {
        const Block block = made_block(own);
        const auto folder =
            std::make_unique<RowFolder>(block, with_discontinuity, discontinuity_scale(kMaxAbs));
        voxelizer->rows(triangle, own, *folder);
        sum.merge(folder->take());
        EXPECT_EQ(folder->take().voxels(), 0);
      }
      const FaceStatistics found = finish(sum, true);
      ASSERT_EQ(found.count, expected.count) << voxelize::text_of(triangle);
      ASSERT_EQ(found.nulls, expected.nulls);
      if (expected.count == 0) continue;
      ASSERT_EQ(found.mean, expected.mean);
      ASSERT_EQ(found.variance, expected.variance);
      ASSERT_EQ(found.min, expected.min);
      ASSERT_EQ(found.max, expected.max);
      if (with_discontinuity && !std::isnan(expected.discontinuity)) {
        ASSERT_EQ(found.discontinuity, expected.discontinuity);
      }
    }
  }
};

TEST_F(FoldRows, EqualsTheDefinitionForEveryKindOfTriangleAndMethod) {
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    voxelize::limit_simd(level);
    voxelize::Numbers numbers(1);
    for (const voxelize::Kind kind : voxelize::kAllKinds) {
      for (int round = 0; round < 3; ++round) {
        const auto t = voxelize::make_triangle(kind, 256 * numbers.within(1, 30),
                                               {256 * 20, 256 * 15, 256 * 25}, numbers);
        expect_definition(t, "exact");
        expect_definition(t, "rotated");
        expect_definition(t, "kaufman");
      }
    }
  }
}

// All voxels in one column, far more than fit a vector's worth of places.
TEST_F(FoldRows, TakesLongColumns) {
  expect_definition({{{2560, 2560, 0}, {2560, 2560, 49 * 256}, {2560, 2560, 256}}}, "exact");
  expect_definition({{{0, 2560, 777}, {39 * 256, 2560, 777}, {256, 2560, 777}}}, "exact");
}

}  // namespace
}  // namespace footwall::extract
