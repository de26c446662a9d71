#include "engine/extract/statistics/moments.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/verify/statistics_by_definition.h"

namespace footwall::extract {
namespace {

std::vector<float> values_of_kind(int kind, std::size_t n, std::mt19937_64& random) {
  std::normal_distribution<float> normal;
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    switch (kind) {
      case 0:
        values[i] = 1000 * normal(random);
        break;  // seismic
      case 1:
        values[i] = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        break;  // any exponent
      case 2:
        values[i] = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0x807fffff);
        break;
      case 3:
        values[i] = (i % 2 == 0 ? 1e30F : -1e30F) + normal(random);
        break;  // cancels
      case 4:
        values[i] = 1e6F + normal(random) * 0.01F;
        break;  // all but constant
      case 5:
        values[i] = i % 3 == 0 ? 3.4e38F : 1e-45F;
        break;  // huge beside tiny
      case 6:
        values[i] = i % 2 == 0 ? 0.0F : -0.0F;
        break;
      default:
        values[i] = static_cast<float>(static_cast<int>(random() % 7) - 3);
        break;
    }
    if (!std::isfinite(values[i])) values[i] = 1;
  }
  return values;
}

void expect_exact(const std::vector<float>& values, const Moments& moments) {
  const auto truth = verify::moments_by_definition(values);
  EXPECT_EQ(moments.count, static_cast<std::int64_t>(values.size()));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(moments.mean()), std::bit_cast<std::uint64_t>(truth.mean));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(moments.variance()), std::bit_cast<std::uint64_t>(truth.variance));
  EXPECT_EQ(moments.min, *std::min_element(values.begin(), values.end()));
  EXPECT_EQ(moments.max, *std::max_element(values.begin(), values.end()));
}

TEST(Moments, AreTheRoundedRationalsForEveryKindOfValue) {
  std::mt19937_64 random(7);
  for (int kind = 0; kind < 8; ++kind) {
    for (const std::size_t n : {1U, 2U, 3U, 15U, 16U, 17U, 100U, 1024U, 1025U, 2500U}) {
      SCOPED_TRACE(testing::Message() << "kind " << kind << ", " << n << " values");
      const std::vector<float> values = values_of_kind(kind, n, random);
      Moments moments;
      fold(values, moments);
      expect_exact(values, moments);
    }
  }
}

TEST(Moments, DoNotDependOnOrderGroupingOrInstructionSet) {
  std::mt19937_64 random(11);
  for (int kind = 0; kind < 8; ++kind) {
    std::vector<float> values = values_of_kind(kind, 3000, random);
    values[5] = std::numeric_limits<float>::quiet_NaN();
    values[77] = std::numeric_limits<float>::infinity();
    Moments whole;
    fold(values, whole);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      std::shuffle(values.begin(), values.end(), random);
      Moments parts;
      for (std::size_t at = 0; at < values.size();) {
        const std::size_t n = std::min<std::size_t>(1 + random() % 400, values.size() - at);
        Moments part;
        fold(std::span(values).subspan(at, n), part);
        parts.merge(part);
        at += n;
      }
      EXPECT_EQ(parts.count, whole.count);
      EXPECT_EQ(parts.nulls, 2);
      EXPECT_EQ(parts.sum, whole.sum);
      EXPECT_EQ(parts.squares, whole.squares);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(parts.min), std::bit_cast<std::uint32_t>(whole.min));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(parts.max), std::bit_cast<std::uint32_t>(whole.max));
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(Moments, NullsAndInfinitiesAreCountedAndLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values{nan, 2,   std::numeric_limits<float>::infinity(),
                                  4,   nan, -std::numeric_limits<float>::infinity()};
  Moments moments;
  fold(values, moments);
  EXPECT_EQ(moments.count, 2);
  EXPECT_EQ(moments.nulls, 4);
  EXPECT_EQ(moments.mean(), 3);
  EXPECT_EQ(moments.variance(), 2);
  EXPECT_EQ(moments.min, 2);
  EXPECT_EQ(moments.max, 4);
}

TEST(Moments, OfNothingHaveNoMeanAndNoVariance) {
  const Moments moments;
  EXPECT_TRUE(std::isnan(moments.mean()));
  EXPECT_EQ(moments.variance(), 0);
}

TEST(Moments, SurviveTheLargestCountOfTheLargestValues) {
  // 2^40 values of the greatest float: merged by doubling.
  Moments moments;
  fold(std::vector<float>{std::numeric_limits<float>::max()}, moments);
  for (int doubling = 0; doubling < 40; ++doubling) {
    const Moments half = moments;
    moments.merge(half);
  }
  EXPECT_EQ(moments.count, std::int64_t{1} << 40);
  EXPECT_EQ(moments.mean(), static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_EQ(moments.variance(), 0);
}

}  // namespace
}  // namespace footwall::extract
