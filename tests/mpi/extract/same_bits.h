// Statistics compared bit by bit; what is undefined is so in both.
#pragma once
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// All NaNs alike.
inline std::uint64_t bits(double value) {
  return std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value);
}

inline bool same_bits(const FaceStatistics& a, const FaceStatistics& b) {
  return a.count == b.count && a.nulls == b.nulls && a.outside == b.outside && bits(a.mean) == bits(b.mean) &&
         bits(a.variance) == bits(b.variance) && bits(a.min) == bits(b.min) && bits(a.max) == bits(b.max) &&
         bits(a.discontinuity) == bits(b.discontinuity) && bits(a.contrast) == bits(b.contrast) &&
         bits(a.offset_voxels) == bits(b.offset_voxels) && bits(a.offset_score) == bits(b.offset_score);
}

inline void expect_equal(const FaceStatistics& got, const FaceStatistics& want) {
  EXPECT_EQ(got.count, want.count);
  EXPECT_EQ(got.nulls, want.nulls);
  EXPECT_EQ(got.outside, want.outside);
  EXPECT_EQ(bits(got.mean), bits(want.mean));
  EXPECT_EQ(bits(got.variance), bits(want.variance));
  EXPECT_EQ(bits(got.min), bits(want.min));
  EXPECT_EQ(bits(got.max), bits(want.max));
  EXPECT_EQ(bits(got.discontinuity), bits(want.discontinuity));
  EXPECT_EQ(bits(got.contrast), bits(want.contrast));
  EXPECT_EQ(bits(got.offset_voxels), bits(want.offset_voxels));
  EXPECT_EQ(bits(got.offset_score), bits(want.offset_score));
}

inline void expect_equal(const std::vector<FaceStatistics>& got, const std::vector<FaceStatistics>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t n = 0; n < got.size(); ++n) {
    SCOPED_TRACE(testing::Message() << "face " << n);
    expect_equal(got[n], want[n]);
  }
}

}  // namespace footwall::extract
