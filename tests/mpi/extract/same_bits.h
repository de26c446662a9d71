// Statistics compared bit by bit; what is undefined is so in both.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/extract/face_numbers.h"

namespace footwall::extract {

// All NaNs alike.
inline std::uint64_t bits(double value) {
  return std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value);
}

inline bool same_bits(const FaceStatistics& a, const FaceStatistics& b) {
  return a.count == b.count && a.nulls == b.nulls && a.outside == b.outside &&
         std::all_of(kFaceNumbers.begin(), kFaceNumbers.end(),
                     [&](const FaceNumber& each) { return bits(a.*each.member) == bits(b.*each.member); });
}

inline void expect_equal(const FaceStatistics& got, const FaceStatistics& want) {
  EXPECT_EQ(got.count, want.count);
  EXPECT_EQ(got.nulls, want.nulls);
  EXPECT_EQ(got.outside, want.outside);
  for (const FaceNumber& each : kFaceNumbers)
    EXPECT_EQ(bits(got.*each.member), bits(want.*each.member)) << each.name;
}

inline void expect_equal(const std::vector<FaceStatistics>& got, const std::vector<FaceStatistics>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t n = 0; n < got.size(); ++n) {
    SCOPED_TRACE(testing::Message() << "face " << n);
    expect_equal(got[n], want[n]);
  }
}

}  // namespace footwall::extract
