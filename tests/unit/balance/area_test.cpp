#include "engine/extract/balance/area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/extract/balance/voxel_weights.h"
#include "engine/voxelize/exact.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

constexpr std::int32_t kFar = 1 << 30;

TEST(FixedArea, IsHalfTheRootOfTheSquareRoundedDown) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 20000; ++n) {
    survey::LatticeTriangle t;
    const int bits = 1 + n % 31;
    const auto draw = [&] { return static_cast<std::int32_t>(random() >> 33) >> (31 - bits); };
    for (survey::LatticePoint& p : t) p = {draw(), draw(), draw()};
    long double square = 0;
    const std::array<long double, 3> a{(long double)t[1].i - t[0].i, (long double)t[1].j - t[0].j,
                                       (long double)t[1].k - t[0].k};
    const std::array<long double, 3> b{(long double)t[2].i - t[0].i, (long double)t[2].j - t[0].j,
                                       (long double)t[2].k - t[0].k};
    for (std::size_t m = 0; m < 3; ++m) {
      const long double part = a[(m + 1) % 3] * b[(m + 2) % 3] - a[(m + 2) % 3] * b[(m + 1) % 3];
      square += part * part;
    }
    const long double area = std::sqrt(square) / 2;
    const auto got = static_cast<long double>(fixed_area(t));
    const long double slack = area * 1e-17L;
    EXPECT_LE(got, area + slack);
    EXPECT_GT(got, area - 1 - slack);
    std::swap(t[0], t[2]);
    EXPECT_EQ(static_cast<long double>(fixed_area(t)), got);
  }
  EXPECT_EQ(fixed_area({{{0, 0, 0}, {768, 0, 0}, {0, 1024, 0}}}), 6 * kAreaPerVoxel2);
  EXPECT_EQ(fixed_area({{{5, 5, 5}, {7, 7, 7}, {9, 9, 9}}}), 0);
}

TEST(FixedArea, HasALargestValueSoThatSumsFit) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  const survey::LatticeTriangle huge{
      {{-kMost, -kMost, kMost}, {kMost, -kMost, -kMost}, {-kMost, kMost, -kMost}}};
  EXPECT_EQ(fixed_area(huge), FixedArea{1} << 61);
  std::vector<Face> faces(1000);
  for (Face& face : faces) face.triangle = huge;
  FixedArea sum = 0;
  for (const FixedArea area : fixed_areas(faces)) sum += area;
  EXPECT_LE(sum, FixedArea{1} << 61);
  EXPECT_GT(sum, FixedArea{1} << 60);
  const survey::LatticeTriangle large{{{-kFar, 0, 0}, {kFar, 0, 0}, {0, kFar, 0}}};
  EXPECT_EQ(fixed_area(large), static_cast<FixedArea>(kFar) * kFar);
}

TEST(LoadDeviation, IsThatOfEquation54) {
  const std::vector<FixedArea> loads{1 * kAreaPerVoxel2, 3 * kAreaPerVoxel2, 5 * kAreaPerVoxel2};
  EXPECT_DOUBLE_EQ(load_deviation(loads), 2);
  EXPECT_EQ(load_deviation(std::span(loads).first(1)), 0);
}

TEST(VoxelWeights, AreNearTheCountInsideAndTheCountBeyond) {
  std::mt19937_64 random(4);
  const survey::Index dims{60, 50, 40};
  const std::vector<Face> faces = random_faces(dims, 400, random);
  const std::vector<std::int64_t> weights = voxel_weights(faces, dims);
  const survey::Box survey{{0, 0, 0}, dims};
  voxelize::ExactScratch scratch;
  double estimated = 0;
  double counted = 0;
  int beyond = 0;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const std::int64_t count = voxelize::count(faces[n].triangle, survey, scratch);
    const survey::Box box = voxelize::bounding_voxels(faces[n].triangle);
    if (survey::intersection(survey::grown(box, 1), survey) != survey::grown(box, 1)) {
      if (survey::intersection(box, survey) != box) {
        ++beyond;
        EXPECT_EQ(weights[n], count);
      }
    } else {
      EXPECT_NEAR(static_cast<double>(weights[n]), static_cast<double>(count),
                  6 + 0.12 * static_cast<double>(count));
    }
    estimated += static_cast<double>(weights[n]);
    counted += static_cast<double>(count);
  }
  EXPECT_GT(beyond, 10);
  EXPECT_NEAR(estimated / counted, 1, 0.01);
}

}  // namespace
}  // namespace footwall::extract
