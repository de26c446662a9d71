#include "engine/isosurface/visible/paper/merge_masks.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/verify/covered_by_definition.h"

namespace footwall::isosurface {
namespace {

TEST(MergeMasks, TheHostGetsWhatAnyRankCovers) {
  comm::Communicator world(MPI_COMM_WORLD);
  // Also with fewer rows of tiles than ranks.
  for (const auto& [width, height] : {std::pair{1, 1}, {70, 9}, {9, 70}, {200, 150}}) {
    std::mt19937 random(static_cast<unsigned>(height));
    verify::CoveredPixels want(width, height);
    render::CoverageMask mine(width, height);
    for (int n = 0; n < 3 * world.size(); ++n) {
      const auto to = [&](int size) { return std::uniform_int_distribution<int>(0, size)(random); };
      const render::PixelRect rect{to(width), to(height), to(width), to(height)};
      want.fill(rect.x0, rect.y0, rect.x1, rect.y1);
      if (n % world.size() == world.rank()) mine.fill(rect);
    }
    merge_masks(world, mine);
    if (world.rank() != 0) continue;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) ASSERT_EQ(mine.covered(x, y), want.entry(x, y) == 1) << x << "," << y;
    }
  }
}

// Binary swap: half of the mask in the first step, a quarter in the second, and a rank's part at the end.
TEST(MergeMasks, SendsAsMuchAsBinarySwapDoes) {
  comm::Communicator world(MPI_COMM_WORLD);
  render::CoverageMask mine(64, 64 * 8);  // 64 rows of 8 tiles
  constexpr std::int64_t kBytes = 64 * 64;
  int core = 1;
  while (2 * core <= world.size()) core *= 2;
  std::int64_t want = 0;
  if (world.rank() >= core) {
    want = kBytes;
  } else {
    for (std::int64_t part = kBytes / 2; part >= kBytes / core; part /= 2) want += part;
    if (world.rank() != 0) want += kBytes / core;
  }
  const std::int64_t before = world.traffic().bytes;
  merge_masks(world, mine);
  EXPECT_EQ(world.traffic().bytes - before, want);
}

}  // namespace
}  // namespace footwall::isosurface
