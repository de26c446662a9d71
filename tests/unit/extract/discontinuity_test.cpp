#include "engine/extract/statistics/discontinuity.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/verify/statistics_by_definition.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kDims{9, 8, 30};

struct Cube {
  std::vector<float> values = std::vector<float>(static_cast<std::size_t>(kDims[0] * kDims[1] * kDims[2]));
  float at(const survey::Index& p) const {
    if (!survey::Box{{0, 0, 0}, kDims}.contains(p)) return std::numeric_limits<float>::quiet_NaN();
    return values[static_cast<std::size_t>((p[0] * kDims[1] + p[1]) * kDims[2] + p[2])];
  }
};

Discontinuity folded(const Cube& cube, const std::vector<survey::Index>& voxels, double max_abs) {
  Discontinuity sum;
  const double scale = discontinuity_scale(max_abs);
  for (std::size_t first = 0; first < voxels.size(); first += kWindowBlock) {
    const std::size_t n = std::min(kWindowBlock, voxels.size() - first);
    Windows windows;
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t k = 0; k < kNeighbours; ++k) {
        const survey::Index& p = voxels[first + v];
        windows.value[k][v] =
            cube.at({p[0] + static_cast<int>(k / 3) - 1, p[1] + static_cast<int>(k % 3) - 1, p[2]});
      }
    }
    fold_windows(windows, n, scale, sum);
  }
  return sum;
}

TEST(Discontinuity, IsTheDefinitionOnEveryInstructionSet) {
  std::mt19937_64 random(17);
  std::normal_distribution<float> normal;
  for (const float gain : {1.0F, 1e-40F, 1e30F}) {
    Cube cube;
    float largest = 0;
    for (float& value : cube.values) {
      value = gain * normal(random);
      largest = std::max(largest, std::abs(value));
      if (random() % 6 == 0) value = std::numeric_limits<float>::quiet_NaN();
    }
    std::vector<survey::Index> voxels;
    for (int n = 0; n < 1000; ++n) {
      voxels.push_back({static_cast<std::int64_t>(random() % 9), static_cast<std::int64_t>(random() % 8),
                        static_cast<std::int64_t>(random() % 30)});
    }
    const auto value = [&](const survey::Index& p) { return cube.at(p); };
    const auto truth = verify::statistics_by_definition(voxels, kDims, value, static_cast<double>(largest),
                                                        Outside::kInside);
    ASSERT_FALSE(std::isnan(truth.discontinuity));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(folded(cube, voxels, static_cast<double>(largest)).value()),
                std::bit_cast<std::uint64_t>(truth.discontinuity));
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(Discontinuity, IsZeroWhereTracesAreAlikeAndUndefinedWithoutEnough) {
  Cube alike;
  for (std::size_t n = 0; n < alike.values.size(); ++n) alike.values[n] = static_cast<float>(n % 30) - 14.5F;
  EXPECT_EQ(folded(alike, {{4, 4, 3}, {0, 0, 9}}, 14.5).value(), 0);

  Cube empty;
  EXPECT_TRUE(std::isnan(folded(empty, {{4, 4, 3}}, 0).value()));

  // In the corner of a survey 4 traces are left; one null more and the voxel drops out.
  Cube corner = alike;
  corner.values[static_cast<std::size_t>(kDims[2] * kDims[1] + 9)] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(folded(corner, {{0, 0, 9}}, 14.5).value()));
}

TEST(Discontinuity, AVolumeThatExceedsItsRecordedMaximumIsReported) {
  Cube cube;
  for (float& value : cube.values) value = 100;
  try {
    folded(cube, {{4, 4, 3}}, 1.0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
  }
}

}  // namespace
}  // namespace footwall::extract
