// Pictures of only what can be seen are the same for every number of ranks, and so is what is extracted.
#include "engine/isosurface/visible/parallel/visible_picture_parallel.h"

#include <gtest/gtest.h>

#include "engine/isosurface/visible/parallel/brick_pillars.h"
#include "mpi/isosurface_visible/layer_difference.h"
#include "rounds.h"
#include "unit/isosurface_visible/visible_scene.h"

namespace footwall::isosurface {
namespace {

void expect_alike(const VisibleReport& here, const VisibleReport& alone) {
  EXPECT_EQ(here.triangles, alone.triangles);
  ASSERT_EQ(here.passes.size(), alone.passes.size());
  for (std::size_t n = 0; n < here.passes.size(); ++n) {
    EXPECT_EQ(here.passes[n].cells, alone.passes[n].cells) << n;
    EXPECT_EQ(here.passes[n].triangles, alone.passes[n].triangles) << n;
    EXPECT_EQ(here.passes[n].uncovered_pixels, alone.passes[n].uncovered_pixels) << n;
  }
}

TEST(VisiblePicture, IsTheSameForEveryNumberOfRanks) {
  comm::Communicator world(MPI_COMM_WORLD);
  std::mt19937 random(17);
  VisibleScene scenes[] = {VisibleScene(ball_volume({45, 50, 41}, 17)), VisibleScene(gyroid({49, 40, 53}, 3)),
                           VisibleScene(random_volume({20, 31, 26}, 3, 0.02)),
                           VisibleScene(random_volume({1, 9, 9}, 3))};
  VisiblePicture picture;
  VisibleDrawing alone;
  for (int round = 0; round < rounds(12); ++round) {
    VisibleScene& scene = scenes[round / 2 % 4];  // two frames each: the second knows what the first saw
    if (round % 2 == 0) {
      picture.forget();
      alone.forget();
    }
    const Interleaving cut = round / 2 % 3 == 0 ? Interleaving{1, 1, 1} : Interleaving{2, 1, 2};
    const BrickPillars pillars(scene.volume.field(), world.size(), world.rank(), cut);
    scene.look_at_random(random);
    VisibleReport report;
    render::ComposeReport composed;
    const render::SurfaceLayer layer = picture.draw(world, pillars.parts(), scene.request, report, composed);
    OneRank one;
    expect_alike(report, alone.draw(one, scene.parts, scene.request));
    if (world.rank() == 0) {
      ASSERT_EQ(difference(scene.whole(), layer), "") << "round " << round;
    }
  }
}

TEST(VisiblePicture, OfVolumesThatAreReadKeepsOnlyWhatARankNeeds) {
  comm::Communicator world(MPI_COMM_WORLD);
  VisibleScene scene(gyroid({49, 40, 53}, 2));
  scene.look(30, 25, 1, true);
  std::vector<float> values;
  const FieldOf field_of = [&](const survey::Box& box) {
    values.clear();
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
          values.push_back(scene.volume.values[static_cast<std::size_t>((i * 40 + j) * 53 + k)]);
      }
    }
    return Field{values, {box.size(0), box.size(1), box.size(2)}, box.lo, scene.volume.size};
  };
  const BrickPillars pillars(field_of, scene.volume.size, world.size(), world.rank(), {1, 1, 1});
  std::int64_t bricks = 0;
  for (const VolumePart& part : pillars.parts()) bricks += part.bricks.count();
  EXPECT_EQ(world.sum(bricks), scene.ranges.dims[0] * scene.ranges.dims[1] * scene.ranges.dims[2]);
  VisiblePicture picture;
  VisibleReport report;
  render::ComposeReport composed;
  int waves = 0;
  const render::SurfaceLayer layer =
      picture.draw(world, pillars.parts(), scene.request, report, composed,
                   [&](int wave, const render::SurfaceLayer&) { EXPECT_EQ(wave, ++waves); });
  EXPECT_EQ(waves, static_cast<int>(report.passes.size()));
  if (world.rank() == 0) {
    EXPECT_EQ(difference(scene.whole(), layer), "");
  }
}

TEST(VisiblePicture, ACancelledOneEndsOnAllRanksAndCanBeDrawnAgain) {
  comm::Communicator world(MPI_COMM_WORLD);
  VisibleScene scene(gyroid({49, 40, 53}, 3));
  scene.look(30, 25, 1, true);
  const BrickPillars pillars(scene.volume.field(), world.size(), world.rank(), {2, 1, 2});
  VisiblePicture picture;
  VisibleReport report;
  render::ComposeReport composed;
  picture.draw(world, pillars.parts(), scene.request, report, composed);
  ASSERT_GT(report.passes.size(), 2U);
  for (const int last : {1, 2}) {
    picture.forget();
    const JobContext job;
    int waves = 0;
    const auto after_wave = [&](int wave, const render::SurfaceLayer&) {
      waves = wave;
      if (wave == last && world.rank() == world.size() - 1) job.cancel();  // the others are not told
    };
    try {
      picture.draw(world, pillars.parts(), scene.request, report, composed, after_wave, job);
      ADD_FAILURE() << "it went on to the end";
    } catch (const comm::AgreedError& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
    EXPECT_EQ(waves, last);
    const render::SurfaceLayer layer = picture.draw(world, pillars.parts(), scene.request, report, composed);
    EXPECT_TRUE(report.finished);
    if (world.rank() == 0) {
      ASSERT_EQ(difference(scene.whole(), layer), "") << "after wave " << last;
    }
  }
}

TEST(VisiblePicture, WorkIsSharedEvenly) {
  comm::Communicator world(MPI_COMM_WORLD);
  VisibleScene scene(ball_volume({120, 120, 120}, 50));
  scene.request.width = scene.request.height = 500;
  scene.look(20, 25, 1, true);
  const BrickPillars pillars(scene.volume.field(), world.size(), world.rank(), kVisibleInterleaving);
  VisiblePicture picture;
  VisibleReport report;
  render::ComposeReport composed;
  picture.draw(world, pillars.parts(), scene.request, report, composed);
  for (const VisiblePass& pass : report.passes) {
    if (world.size() > 4 || pass.triangles * 20 < report.triangles) continue;
    EXPECT_LT(pass.load_difference, 0.05) << pass.triangles;
  }
}

}  // namespace
}  // namespace footwall::isosurface
