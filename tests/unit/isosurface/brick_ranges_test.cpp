#include "engine/isosurface/brick_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

TEST(BrickRanges, CoverTheSamplesOfTheirCells) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(-5, 5);
  for (const survey::Index& size : {survey::Index{1, 1, 1}, {17, 9, 33}, {8, 10, 100}}) {
    std::vector<float> values(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    for (std::size_t n = 0; n < values.size(); ++n) {
      // The first half of the volume is full of nulls.
      values[n] = n < values.size() / 2 || random() % 50 == 0 ? NAN : value(random);
    }
    for (int threads = 1; threads <= 2; ++threads) {
      const BrickRanges ranges = brick_ranges({values, size, {0, 0, 0}, size}, threads);
      std::size_t brick = 0;
      for (std::int64_t a = 0; a < ranges.dims[0]; ++a) {
        for (std::int64_t b = 0; b < ranges.dims[1]; ++b) {
          for (std::int64_t c = 0; c < ranges.dims[2]; ++c, ++brick) {
            float least = kInf;
            float greatest = -kInf;
            bool null = false;
            for (std::int64_t i = 8 * a; i <= std::min(8 * a + 8, size[0] - 1); ++i) {
              for (std::int64_t j = 8 * b; j <= std::min(8 * b + 8, size[1] - 1); ++j) {
                for (std::int64_t k = 8 * c; k <= std::min(8 * c + 8, size[2] - 1); ++k) {
                  const float v = values[static_cast<std::size_t>((i * size[1] + j) * size[2] + k)];
                  null = null || std::isnan(v);
                  if (v < least) least = v;
                  if (v > greatest) greatest = v;
                }
              }
            }
            ASSERT_EQ(ranges.min[brick], least);
            ASSERT_EQ(ranges.max[brick], greatest);
            ASSERT_EQ(ranges.has_null[brick] != 0, null);
          }
        }
      }
      ASSERT_EQ(brick, ranges.min.size());
    }
  }
}

// Of a part only its samples count, and what it has nothing of can hold no surface.
TEST(BrickRanges, OfAPartAreThoseOfItsSamples) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const survey::Index volume{30, 9, 20};
  std::vector<float> whole(static_cast<std::size_t>(volume[0] * volume[1] * volume[2]), NAN);
  const survey::Index origin{7, 0, 3};
  const survey::Index size{12, 9, 10};
  std::vector<float> part;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> value(-5, 5);
  for (std::int64_t i = 0; i < size[0]; ++i) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t k = 0; k < size[2]; ++k) {
        part.push_back(value(random));
        const std::int64_t row = (origin[0] + i) * volume[1] + origin[1] + j;
        whole[static_cast<std::size_t>(row * volume[2] + origin[2] + k)] = part.back();
      }
    }
  }
  const BrickRanges want = brick_ranges({whole, volume, {0, 0, 0}, volume}, 1);
  const BrickRanges got = brick_ranges({part, size, origin, volume}, 2);
  EXPECT_EQ(got.dims, want.dims);
  EXPECT_EQ(got.min, want.min);
  EXPECT_EQ(got.max, want.max);
  EXPECT_EQ(got.min.back(), kInf);
}

TEST(BrickRanges, AreMadeOfSamplesOfAVolume) {
  const std::vector<float> values(8);
  EXPECT_THROW(brick_ranges({values, {2, 2, 2}, {0, 0, 2}, {2, 2, 3}}, 1), Error);
  EXPECT_THROW(brick_ranges({values, {2, 2, 0}, {0, 0, 0}, {2, 2, 3}}, 1), Error);
}

}  // namespace
}  // namespace footwall::isosurface
