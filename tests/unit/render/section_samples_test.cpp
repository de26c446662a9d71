#include "engine/render/section_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace footwall::render {
namespace {

SectionPlane checkered(int rows, int columns) {
  SectionPlane s;
  s.rows = rows;
  s.columns = columns;
  for (int n = 0; n < rows * columns; ++n)
    s.values.push_back((n / columns + n % columns) % 2 == 0 ? 0.0F : 1.0F);
  return s;
}

TEST(SectionSamples, AreSquaresWhenLargeBlendedWhenSmallAveragedWhenTiny) {
  const SectionPlane s = checkered(20, 20);
  EXPECT_TRUE(shows_squares(0.01, 0.01, 3)) << "a texel of 33 pixels is one square";
  EXPECT_FALSE(shows_squares(0.01, 0.2, 3));
  EXPECT_EQ(section_value(s, 4.4, 7.4, 0.01, 0.01, true), 1);
  EXPECT_NEAR(section_value(s, 4, 7.25, 0.2, 0.2, false), 0.75, 1e-12);
  EXPECT_NEAR(section_value(s, 9.5, 9.5, 8, 8, false), 0.5, 0.05)
      << "many texels in a pixel must not flicker";
}

TEST(SectionSamples, KeepNullsNull) {
  SectionPlane s = checkered(4, 4);
  s.values[5] = NAN;
  EXPECT_TRUE(std::isnan(section_value(s, 1, 1, 0.2, 0.2, false)));
  EXPECT_FALSE(std::isnan(section_value(s, 1, 1.6, 0.2, 0.2, false))) << "a neighbour stays";
  EXPECT_TRUE(std::isnan(section_value(s, NAN, 1, 0.2, 0.2, false)));
  EXPECT_EQ(section_value(s, -30, -30, 0.2, 0.2, false), 0) << "beyond the border stands the border's value";
}

}  // namespace
}  // namespace footwall::render
