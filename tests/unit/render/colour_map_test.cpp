#include "engine/render/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

// CIE lightness of an sRGB colour.
double lightness(Rgba c) {
  const auto linear = [](unsigned v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(red(c)) + 0.7152 * linear(green(c)) + 0.0722 * linear(blue(c));
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(ColourMap, SequentialMapsGrowLighterEvenly) {
  for (const ColourMap& map : ColourMap::all()) {
    if (map.kind() != ColourMapKind::kSequential) continue;
    for (int n = 16; n <= 240; n += 16) {
      const double rise = lightness(map.colour_of(n + 15, 0, 255)) - lightness(map.colour_of(n, 0, 255));
      EXPECT_GT(rise, 2.5) << map.name() << " at " << n;
      EXPECT_LT(rise, 9) << map.name() << " at " << n;
    }
  }
}

TEST(ColourMap, DivergingMapsAreLightestAndNeutralInTheMiddle) {
  for (const ColourMap& map : ColourMap::all()) {
    if (map.kind() != ColourMapKind::kDiverging) continue;
    const Rgba middle = map.colour_of(0, -1, 1);
    EXPECT_GT(lightness(middle), 95) << map.name();
    EXPECT_LT(std::max({red(middle), green(middle), blue(middle)}) -
                  std::min({red(middle), green(middle), blue(middle)}),
              8U);
    for (const double sign : {-1.0, 1.0}) {
      for (double v = 0.1; v <= 1; v += 0.1) {
        EXPECT_LT(lightness(map.colour_of(sign * v, -1, 1)),
                  lightness(map.colour_of(sign * (v - 0.1), -1, 1)) + 0.01)
            << map.name();
      }
    }
  }
  EXPECT_GT(red(ColourMap::named("red-white-blue").colour_of(-0.8, -1, 1)), 150U);
  EXPECT_GT(blue(ColourMap::named("seismic").colour_of(-0.5, -1, 1)), 150U);
}

TEST(ColourMap, ClampsAndMarksWhatIsNotANumber) {
  const ColourMap& map = ColourMap::named("viridis");
  EXPECT_EQ(map.colour_of(-5, 0, 1), hex(0x440154));
  EXPECT_EQ(map.colour_of(INFINITY, 0, 1), hex(0xfde725));
  EXPECT_EQ(map.colour_of(NAN, 0, 1), ColourMap::kUndefined);
  EXPECT_EQ(map.colour_of(3, 2, 2), map.colour_of(0.5, 0, 1));
  try {
    ColourMap::named("rainbow");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    EXPECT_NE(error.hint().find("cividis"), std::string::npos);
  }
}

TEST(ColourMap, RangesLeaveOutliersAndNullsOut) {
  std::vector<double> values;
  for (int n = 0; n <= 100; ++n) values.push_back(n);
  values.push_back(NAN);
  values[50] = INFINITY;
  const Range range = percentile_range(values).value();
  EXPECT_NEAR(range.lo, 2, 1);
  EXPECT_NEAR(range.hi, 98, 1.01);
  EXPECT_FALSE(percentile_range(std::vector<double>{NAN}).has_value());
  const Range one = percentile_range(std::vector<double>{4}).value();
  EXPECT_LT(one.lo, 4);
  EXPECT_GT(one.hi, 4);
  const Range symmetric = symmetric_range(std::vector<float>{-3, 1, NAN, 2}, 100).value();
  EXPECT_EQ(symmetric.lo, -3);
  EXPECT_EQ(symmetric.hi, 3);
  EXPECT_GT(symmetric_range(std::vector<float>{0, 0}).value().hi, 0);
}

}  // namespace
}  // namespace footwall::render
