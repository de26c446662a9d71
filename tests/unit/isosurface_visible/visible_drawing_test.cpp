#include "engine/isosurface/visible/visible_drawing.h"

#include <gtest/gtest.h>

#include <chrono>

#include "engine/voxelize/simd.h"
#include "rounds.h"
#include "storage/base/error.h"
#include "unit/isosurface_visible/visible_scene.h"

namespace footwall::isosurface {
namespace {

TEST(VisibleDrawing, IsThePictureOfTheWholeSurface) {
  std::mt19937 random(5);
  VisibleScene scenes[] = {VisibleScene(ball_volume({45, 50, 41}, 17)), VisibleScene(gyroid({49, 40, 53}, 3)),
                           VisibleScene(random_volume({20, 31, 26}, 3, 0.02))};
  scenes[1].request.placement = {{0, 12.5, 0, 25, 3, 0, 0, 0, -4}, {100, -50, 7}};
  for (int round = 0; round < rounds(18); ++round) {
    VisibleScene& scene = scenes[round % 3];
    scene.look_at_random(random);
    ASSERT_EQ(scene.difference(), "") << "round " << round;
  }
}

TEST(VisibleDrawing, ShowsWhatAMaskWithoutDepthLoses) {
  VisibleScene scene(sliver_plate_plate());
  for (const bool perspective : {true, false}) {
    scene.look_from({12, 12, -60}, {12, 12, 12}, perspective);
    ASSERT_EQ(scene.difference(), "");
    scene.look(3, -2, 1, perspective);
    ASSERT_EQ(scene.difference(), "");
  }
}

// Frame after frame with the same drawing: what was seen last is drawn first.
TEST(VisibleDrawing, StaysRightWhileTheCameraMoves) {
  VisibleScene scene(gyroid({49, 40, 53}, 2));
  VisibleDrawing drawing;
  VisibleReport report;
  scene.look(20, 10, 1.2, true);
  ASSERT_EQ(scene.difference(drawing, report), "");
  const std::int64_t first = report.passes.front().triangles;
  ASSERT_EQ(scene.difference(drawing, report), "");
  EXPECT_NE(report.passes.front().triangles, first);  // now it is known what is seen
  EXPECT_GE(report.passes.front().percent, 99);
  for (int frame = 0; frame < 5; ++frame) {
    scene.look(25 + 30 * frame, 10 - 15 * frame, 1.2, frame % 2 == 0);
    if (frame == 3) scene.request.isovalue = 0.4F;
    ASSERT_EQ(scene.difference(drawing, report), "") << frame;
  }
}

TEST(VisibleDrawing, IsTheSameOnAllInstructionSetsAndThreadCounts) {
  VisibleScene scene(gyroid({49, 40, 53}, 3));
  scene.look(20, 10, 1.2, true);
  VisibleDrawing drawing;
  VisibleReport first;
  ASSERT_EQ(scene.difference(drawing, first), "");
  for (const auto level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    voxelize::limit_simd(level);
    for (int threads = 1; threads <= 3; ++threads) {
      scene.request.threads = threads;
      drawing.forget();
      VisibleReport report;
      EXPECT_EQ(scene.difference(drawing, report), "");
      EXPECT_EQ(report.passes.size(), first.passes.size());
      EXPECT_EQ(report.triangles, first.triangles);
      EXPECT_EQ(report.passes[0].uncovered_pixels, first.passes[0].uncovered_pixels);
    }
  }
  voxelize::limit_simd(std::nullopt);
}

TEST(VisibleDrawing, MostIsThereAfterTheFirstWave) {
  for (const double zoom : {1.0, 3.0}) {
    VisibleScene scene(ball_volume({90, 90, 90}, 38));
    scene.request.width = scene.request.height = 400;
    scene.look(30, 25, zoom, true);
    const verify::SurfacePicture whole = scene.whole();
    VisibleDrawing drawing;
    OneRank alone;
    std::int64_t first = 0;
    const VisibleReport report = drawing.draw(alone, scene.parts, scene.request, [&](int wave) {
      if (wave == 1) first = verify::final_pixels(whole, drawing.window());
    });
    EXPECT_GE(first * 10, whole.pixels * 9);
    EXPECT_LE(report.passes.size(), 5U);
    EXPECT_LT(report.triangles, whole.triangles / 2);
    EXPECT_LE(report.triangles * 10, whole.owning_triangles * 16);
  }
}

TEST(VisibleDrawing, ABudgetLeavesAPictureAndTellsWhatIsOpen) {
  VisibleScene scene(gyroid({60, 60, 60}, 3));
  scene.look(30, 25, 1, true);
  const verify::SurfacePicture whole = scene.whole();
  OneRank alone;
  VisibleDrawing drawing;
  scene.request.passes = 1;
  const VisibleReport one = drawing.draw(alone, scene.parts, scene.request);
  ASSERT_EQ(one.passes.size(), 1U);
  EXPECT_FALSE(one.finished);
  std::int64_t missing = 0;
  for (std::size_t n = 0; n < whole.depths.size(); ++n) {
    const render::Visible pixel = drawing.window().pixels()[n];
    missing += whole.depths[n] < 1 && pixel == render::kBackground ? 1 : 0;
    EXPECT_GE(render::depth_of(pixel), whole.depths[n]);
  }
  EXPECT_GT(one.passes[0].uncovered_pixels, 0);
  EXPECT_GE(one.passes[0].uncovered_pixels, missing);
  scene.request.passes = 0;
  scene.request.budget_seconds = 0;
  drawing.forget();
  const VisibleReport hasty = drawing.draw(alone, scene.parts, scene.request);
  EXPECT_EQ(hasty.passes.size(), 1U);
  EXPECT_FALSE(hasty.finished);
  scene.request.budget_seconds = 1e6;
  EXPECT_TRUE(drawing.draw(alone, scene.parts, scene.request).finished);
}

TEST(VisibleDrawing, WhatIsDoneAfterAWaveTakesNoTimeOfTheBudget) {
  VisibleScene scene(gyroid({60, 60, 60}, 3));
  scene.look(30, 25, 1, true);
  scene.request.budget_seconds = 0.3;
  OneRank alone;
  VisibleDrawing drawing;
  VisibleReport report;
  // Five times, since a busy machine may take the budget for the drawing itself.
  for (int n = 0; n < 5 && (n == 0 || !report.finished); ++n) {
    drawing.forget();
    report = drawing.draw(alone, scene.parts, scene.request, [&](int wave) {
      const auto start = std::chrono::steady_clock::now();
      while (wave == 1 && std::chrono::steady_clock::now() - start < std::chrono::milliseconds(310)) {
      }
    });
  }
  EXPECT_TRUE(report.finished);
  EXPECT_GT(report.passes.size(), 1U);
}

TEST(VisibleDrawing, StandsUglyVolumesAndIsovalues) {
  VisibleDrawing drawing;
  VisibleReport report;
  for (const survey::Index& size : {survey::Index{1, 1, 1}, {1, 9, 1}, {2, 2, 2}, {1, 12, 20}, {17, 2, 9}}) {
    VisibleScene scene(random_volume(size, 4));
    scene.look(30, 25, 1, true);
    drawing.forget();
    ASSERT_EQ(scene.difference(drawing, report), "") << size[0] << " " << size[1] << " " << size[2];
  }
  VisibleScene scene(random_volume({20, 20, 20}, 4, 0.1));
  scene.volume.values[77] = INFINITY;
  scene.volume.values[5000] = -INFINITY;
  scene.ranges = brick_ranges(scene.volume.field(), 1);
  scene.request.bricks = scene.ranges.tables();
  scene.look(200, -40, 1.5, false);
  for (const float isovalue : {0.0F, 5.0F, -5.0F, scene.volume.values[100]}) {
    scene.request.isovalue = std::isfinite(isovalue) ? isovalue : 0.25F;
    ASSERT_EQ(scene.difference(drawing, report), "") << isovalue;
  }
  VisibleScene plain(random_volume({20, 20, 20}, 4));
  plain.request.isovalue = 5;
  plain.look(200, -40, 1.5, false);
  ASSERT_EQ(plain.difference(drawing, report), "");
  EXPECT_EQ(report.passes.size(), 1U);
  EXPECT_EQ(report.triangles, 0);
}

TEST(VisibleDrawing, RefusesWhatDoesNotFit) {
  VisibleScene scene(ball_volume({20, 20, 20}, 7));
  scene.look(30, 25, 1, true);
  VisibleDrawing drawing;
  OneRank alone;
  VisibleRequest request = scene.request;
  request.isovalue = NAN;
  EXPECT_THROW(drawing.draw(alone, scene.parts, request), Error);
  request = scene.request;
  request.volume_size = {90, 20, 20};
  EXPECT_THROW(drawing.draw(alone, scene.parts, request), Error);
  request = scene.request;
  request.width = 0;
  EXPECT_THROW(drawing.draw(alone, scene.parts, request), Error);
  std::vector<VolumePart> parts = scene.parts;
  parts[0].field.size[0] -= 1;
  EXPECT_THROW(drawing.draw(alone, parts, scene.request), Error);
}

}  // namespace
}  // namespace footwall::isosurface
