#include "engine/isosurface/visible/detail/expected_triangles.h"

#include <gtest/gtest.h>

#include "engine/isosurface/visible/active_parts.h"
#include "unit/isosurface_visible/visible_scene.h"

namespace footwall::isosurface::detail {
namespace {

render::DepthPyramid open_depths() {
  render::DepthPyramid depths({0, 0, kWidth - 1, kHeight - 1, 0, 0});
  depths.build();
  return depths;
}

// Of all of the surface, in triangles.
double expected_of(const VisibleScene& scene, const render::DepthPyramid& depths) {
  const ExpectedTriangles expected(scene.request, {&depths, render::DepthScale::between(0, 1)});
  std::int64_t sum = 0;
  for (std::int64_t a = 0; a < scene.ranges.dims[0]; ++a) {
    for (std::int64_t b = 0; b < scene.ranges.dims[1]; ++b) {
      for (std::int64_t c = 0; c < scene.ranges.dims[2]; ++c) {
        const BrickParts parts = active_parts(scene.volume.field(), {a, b, c}, scene.request.isovalue);
        sum += expected.of(scene.volume.field(), {a, b, c}, parts);
      }
    }
  }
  return static_cast<double>(sum) / static_cast<double>(ExpectedTriangles::kTriangle);
}

VisibleScene level_plane() {
  return VisibleScene(sampled({24, 21, 18}, [](auto, auto, auto k) { return 9.4 - static_cast<double>(k); }));
}

TEST(ExpectedTriangles, AreMostOfThoseThatAreSeenFaceOn) {
  VisibleScene plane = level_plane();
  plane.look(0, 90, 1, false);
  const double made = 2.0 * 23 * 20;
  const double expected = expected_of(plane, open_depths());
  EXPECT_GT(expected, 0.7 * made);
  EXPECT_LT(expected, 1.1 * made);
}

TEST(ExpectedTriangles, AreFewWhereTheSurfaceRunsAlongARowOfPixels) {
  VisibleScene plane = level_plane();
  plane.look(0, 0, 1, false);
  EXPECT_LT(expected_of(plane, open_depths()), 0.05 * 2 * 23 * 20);
}

TEST(ExpectedTriangles, AreThoseBeforeWhatWasDrawnAndInsideThePicture) {
  VisibleScene plane = level_plane();
  plane.look(0, 90, 1, false);
  const double all = expected_of(plane, open_depths());
  render::DepthPyramid half = open_depths();
  half.cover({0, 0, kWidth / 2, kHeight - 1, 0, 0}, 1);
  half.build();
  EXPECT_NEAR(expected_of(plane, half), all / 2, all / 10);
  render::DepthPyramid whole = open_depths();
  whole.cover({0, 0, kWidth - 1, kHeight - 1, 0, 0}, 1);
  whole.build();
  EXPECT_EQ(expected_of(plane, whole), 0);
  plane.look(0, 90, 8, false);
  EXPECT_LT(expected_of(plane, open_depths()), all / 4);
}

TEST(ExpectedTriangles, StandNullsInfinitiesAndTheEyeInside) {
  VisibleScene scene(random_volume({20, 31, 26}, 4, 0.1));
  scene.volume.values[77] = INFINITY;
  scene.volume.values[5000] = -INFINITY;
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    scene.look_at_random(random);
    const double expected = expected_of(scene, open_depths());
    EXPECT_GE(expected, 0);
    EXPECT_LT(expected, 19.0 * 30 * 25 * 12);  // a cell has at most so many
  }
}

}  // namespace
}  // namespace footwall::isosurface::detail
