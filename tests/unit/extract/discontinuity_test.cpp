#include "engine/extract/statistics/discontinuity.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <sys/mman.h>

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

// The same by places in memory, where the cube has a halo without values.
Discontinuity folded_around(const Cube& cube, const std::vector<survey::Index>& voxels, double max_abs) {
  const std::int64_t i_stride = (kDims[1] + 2) * kDims[2];
  std::vector<float> stored;
  for (std::int64_t i = -1; i <= kDims[0]; ++i) {
    for (std::int64_t j = -1; j <= kDims[1]; ++j) {
      for (std::int64_t k = 0; k < kDims[2]; ++k) stored.push_back(cube.at({i, j, k}));
    }
  }
  std::vector<std::int64_t> places;
  for (const survey::Index& p : voxels)
    places.push_back((p[0] + 1) * i_stride + (p[1] + 1) * kDims[2] + p[2]);
  Discontinuity sum;
  Windows room;
  for (std::size_t first = 0; first < places.size(); first += kWindowBlock) {
    fold_around({stored.data(), i_stride, kDims[2]}, places.data() + first,
                std::min(kWindowBlock, places.size() - first), discontinuity_scale(max_abs), room, sum);
  }
  return sum;
}

// Both ways must agree.
double value_of(const Cube& cube, const std::vector<survey::Index>& voxels, double max_abs) {
  const Discontinuity sum = folded(cube, voxels, max_abs);
  const Discontinuity around = folded_around(cube, voxels, max_abs);
  EXPECT_TRUE(sum.num == around.num && sum.den == around.den);
  return around.value();
}

TEST(Discontinuity, IsTheDefinitionOnEveryInstructionSet) {
  std::mt19937_64 random(17);
  std::normal_distribution<float> normal;
  // With few nulls most windows are whole.
  for (const auto& [gain, nulls] : {std::pair(1.0F, 6U), {1e-40F, 6U}, {1e30F, 6U}, {1.0F, 400U}}) {
    Cube cube;
    float largest = 0;
    for (float& value : cube.values) {
      value = gain * normal(random);
      largest = std::max(largest, std::abs(value));
      if (random() % nulls == 0) value = std::numeric_limits<float>::quiet_NaN();
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
      EXPECT_EQ(std::bit_cast<std::uint64_t>(value_of(cube, voxels, static_cast<double>(largest))),
                std::bit_cast<std::uint64_t>(truth.discontinuity));
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(Discontinuity, IsZeroWhereTracesAreAlikeAndUndefinedWithoutEnough) {
  Cube alike;
  for (std::size_t n = 0; n < alike.values.size(); ++n) alike.values[n] = static_cast<float>(n % 30) - 14.5F;
  EXPECT_EQ(value_of(alike, {{4, 4, 3}, {0, 0, 9}}, 14.5), 0);

  Cube empty;
  EXPECT_TRUE(std::isnan(value_of(empty, {{4, 4, 3}}, 0)));

  // In the corner of a survey 4 traces are left; one null more and the voxel drops out.
  Cube corner = alike;
  corner.values[static_cast<std::size_t>(kDims[2] * kDims[1] + 9)] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(value_of(corner, {{0, 0, 9}}, 14.5)));
}

TEST(Discontinuity, AVolumeThatExceedsItsRecordedMaximumIsReported) {
  Cube cube;
  for (float& value : cube.values) value = 100;
  const std::vector<survey::Index> voxels(20, {4, 4, 3});  // some in a vector, some after it
  for (const auto& fold : {&folded, &folded_around}) {
    try {
      fold(cube, voxels, 1.0);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
    }
  }
}

// As in a block of more than 8 GiB, of which a few pages are used.
TEST(Discontinuity, VoxelsMayLieFarApart) {
  constexpr std::int64_t kValues = std::int64_t{9} << 28;
  constexpr std::size_t kBytes = kValues * sizeof(float);
  void* const memory =
      mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) GTEST_SKIP() << "no room for 9 GiB of addresses";
  auto* const values = static_cast<float*>(memory);
  constexpr std::int64_t kStride = 50;
  std::vector<std::int64_t> places;
  std::mt19937_64 random(3);
  for (int n = 0; n < 200; ++n) {
    const std::int64_t place =
        100 + static_cast<std::int64_t>(random() % 1000) + (n % 3 == 0 ? kValues - 2000 : 0);
    places.push_back(place);
    values[place] = static_cast<float>(random() % 100);
  }
  Windows room;
  Discontinuity together;
  Discontinuity alone;
  fold_around({values, kStride, 1}, places.data(), places.size(), discontinuity_scale(100), room, together);
  for (const std::int64_t place : places)
    fold_around({values, kStride, 1}, &place, 1, discontinuity_scale(100), room, alone);
  EXPECT_TRUE(together.num == alone.num && together.den == alone.den);
  EXPECT_GT(together.value(), 0);
  munmap(memory, kBytes);
}

}  // namespace
}  // namespace footwall::extract
