#include "engine/voxelize/simd.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::voxelize {
namespace {

TEST(Simd, NamesReadBack) {
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    EXPECT_EQ(simd_level_from(name_of(level)), level);
  }
  EXPECT_THROW(simd_level_from("sse9"), Error);
  EXPECT_THROW(simd_level_from(""), Error);
}

TEST(Simd, ALimitIsACeilingAndCanBeLifted) {
  limit_simd(std::nullopt);
  const std::string best = simd_in_use();
  limit_simd(SimdLevel::kBaseline);
  const std::string baseline = simd_in_use();
  EXPECT_EQ(baseline.find("AVX"), std::string::npos) << baseline;
  EXPECT_EQ(baseline.find("SSE4"), std::string::npos) << baseline;
  limit_simd(SimdLevel::kAvx2);
  EXPECT_EQ(simd_in_use().find("AVX3"), std::string::npos) << simd_in_use();
  limit_simd(std::nullopt);
  EXPECT_EQ(simd_in_use(), best);
  limit_simd(forced_simd());
}

}  // namespace
}  // namespace footwall::voxelize
