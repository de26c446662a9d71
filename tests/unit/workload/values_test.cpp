#include "engine/tasks/workload/values.h"

#include <gtest/gtest.h>

#include <vector>

namespace footwall::tasks {
namespace {

const survey::Index kDims{7, 9, 11};

TEST(Values, OfAVoxelAreTheSameInEveryBox) {
  const survey::Box whole{{0, 0, 0}, kDims}, part{{2, 3, 4}, {5, 9, 6}};
  std::vector<float> all(static_cast<std::size_t>(whole.count())),
      some(static_cast<std::size_t>(part.count()));
  fill_hashed(kDims, 3, whole, all);
  fill_hashed(kDims, 3, part, some);
  std::size_t n = 0;
  for (std::int64_t i = part.lo[0]; i < part.hi[0]; ++i) {
    for (std::int64_t j = part.lo[1]; j < part.hi[1]; ++j) {
      for (std::int64_t k = part.lo[2]; k < part.hi[2]; ++k)
        EXPECT_EQ(some[n++], all[static_cast<std::size_t>((i * kDims[1] + j) * kDims[2] + k)]);
    }
  }
}

TEST(Values, AreEvenAndDifferWithTheSeed) {
  double sum = 0, squares = 0, product = 0;
  constexpr int kCount = 100000;
  for (std::uint64_t n = 0; n < kCount; ++n) {
    const float value = hashed_value(n, 1);
    ASSERT_TRUE(value >= -1 && value < 1);
    sum += value;
    squares += value * value;
    product += value * hashed_value(n, 2);
  }
  // Standard deviations of these means: 0.0018, 0.00094, 0.0011.
  EXPECT_NEAR(sum / kCount, 0, 0.008);
  EXPECT_NEAR(squares / kCount, 1.0 / 3, 0.004);
  EXPECT_NEAR(product / kCount, 0, 0.005);
}

}  // namespace
}  // namespace footwall::tasks
