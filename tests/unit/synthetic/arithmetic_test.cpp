#include "engine/synthetic/detail/arithmetic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace footwall::synthetic::detail {
namespace {

TEST(Arithmetic, ExponentialAgreesWithTheLibrary) {
  for (double x = 0; x < 40; x += 0.37) EXPECT_NEAR(exp_of_minus(x) / std::exp(-x), 1, 1e-12) << x;
}

TEST(Arithmetic, SineAgreesWithTheLibrary) {
  for (double x = -7; x < 7; x += 0.013) EXPECT_NEAR(sine_of_turns(x), std::sin(2 * M_PI * x), 1e-8) << x;
}

TEST(Arithmetic, StepIsLevelOutside) {
  EXPECT_EQ(smooth_step(-3), 0);
  EXPECT_EQ(smooth_step(0.5), 0.5);
  EXPECT_EQ(smooth_step(1.5), 1);
}

}  // namespace
}  // namespace footwall::synthetic::detail
