#include "storage/survey/geometry.h"

#include <gtest/gtest.h>

#include <limits>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

Geometry rotated_survey() {
  Geometry g;
  g.inlines = {300, 2, 100};
  g.crosslines = {601, 1, 80};
  g.samples = 50;
  g.z0 = 1000;
  g.interval = 4;
  g.map = {606214.3, 6084991.7, 20.0, 15.0, -9.0, 12.0};
  return g;
}

TEST(Geometry, IndexAndWorldAreInverse) {
  const Geometry g = rotated_survey();
  const WorldPoint world = g.world_of({12.25, 70.5, 3});
  EXPECT_DOUBLE_EQ(world.z, 1012);
  const IndexPoint back = g.index_of(world);
  EXPECT_NEAR(back.i, 12.25, 1e-9);
  EXPECT_NEAR(back.j, 70.5, 1e-9);
  EXPECT_NEAR(back.k, 3, 1e-12);
}

TEST(Geometry, LineNumbersMapToIndices) {
  const LineAxis lines{300, 2, 100};
  EXPECT_EQ(lines.last(), 498);
  EXPECT_EQ(lines.index_of(304), 2);
  EXPECT_EQ(lines.index_of(305), -1);
  EXPECT_EQ(lines.line_of(99), 498);
}

TEST(Geometry, RefusesWhatCannotBeASurvey) {
  EXPECT_NO_THROW(rotated_survey().validate());
  Geometry g = rotated_survey();
  g.interval = 0;
  EXPECT_THROW(g.validate(), Error);
  g = rotated_survey();
  g.map.per_crossline_x = g.map.per_inline_x;
  g.map.per_crossline_y = g.map.per_inline_y;
  EXPECT_THROW(g.validate(), Error);
  EXPECT_THROW(g.index_of({0, 0, 0}), Error);
  g = rotated_survey();
  g.map.origin_x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(g.validate(), Error);
  g = rotated_survey();
  g.samples = 0;
  EXPECT_THROW(g.validate(), Error);
  g = rotated_survey();
  g.vertical_unit = VerticalUnit::kMetre;
  EXPECT_THROW(g.validate(), Error) << "time in metres";
}

TEST(Geometry, NamesReadBack) {
  EXPECT_EQ(domain_from(name_of(Domain::kDepth)), Domain::kDepth);
  EXPECT_EQ(vertical_unit_from(name_of(VerticalUnit::kFoot)), VerticalUnit::kFoot);
  EXPECT_THROW(domain_from("times"), Error);
  EXPECT_THROW(vertical_unit_from("s"), Error);
}

TEST(Geometry, TimeNeedsAVelocityToBecomeMetres) {
  const Geometry g = rotated_survey();
  EXPECT_FALSE(g.has_metric_depth());
  EXPECT_DOUBLE_EQ(g.vertical_metres(1000, 2000), 1000);
}

}  // namespace
}  // namespace footwall::survey
