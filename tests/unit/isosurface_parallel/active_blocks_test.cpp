#include "engine/isosurface/parallel/active_blocks.h"

#include <gtest/gtest.h>

#include "storage/base/splitmix64.h"
#include "unit/isosurface_parallel/sample_pyramid.h"

namespace footwall::isosurface {
namespace {

// One brick in `every` is crossed by the isovalue 0.
Pyramid scattered(const survey::Index& dims, int every) {
  SplitMix64 random(3);
  return {dims, [&](const survey::Index&) { return random.next() % static_cast<std::uint64_t>(every) == 0; }};
}

TEST(ActiveBlocks, HoldEveryActiveBrickOnce) {
  for (const int every : {1, 5, 40, 400}) {
    const Pyramid pyramid = scattered({9, 7, 12}, every);
    const survey::Box cells{{3, 0, 5}, {70, 50, 93}};
    const std::vector<survey::Box> blocks = active_blocks(cells, {&pyramid.bricks, 0, false, 1 << 15});
    std::int64_t looked_at = 0;
    for (const survey::Box& block : blocks) {
      looked_at += block.count();
      EXPECT_EQ(intersection(block, cells), block);
      EXPECT_LE(block.count(), 1 << 15);
    }
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
        for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
          int times = 0;
          for (const survey::Box& block : blocks) times += block.contains({i, j, k}) ? 1 : 0;
          ASSERT_LE(times, 1);
          if (is_active(pyramid.bricks, {i / 8, j / 8, k / 8}, 0)) {
            ASSERT_EQ(times, 1);
          }
        }
      }
    }
    if (every == 400) {
      EXPECT_LT(looked_at, cells.count() / 4);
    }
  }
}

TEST(ActiveBlocks, WithoutPyramidAllOfThePillar) {
  const survey::Box cells{{0, 0, 0}, {20, 10, 30}};
  EXPECT_EQ(active_blocks(cells, {nullptr, 0, false, 1 << 20}), (std::vector<survey::Box>{cells}));
  EXPECT_TRUE(active_blocks({}, {nullptr, 0, false, 1 << 20}).empty());
}

// A body that fills the border has a cap there, where no surface passes.
TEST(ActiveBlocks, CapsWantTheFilledBorder) {
  const Pyramid pyramid = scattered({4, 4, 4}, 1 << 30);
  const survey::Box cells{{0, 0, 0}, {32, 32, 32}};
  EXPECT_TRUE(active_blocks(cells, {&pyramid.bricks, 0, false, 1 << 20}).empty());
  EXPECT_EQ(active_blocks(cells, {&pyramid.bricks, 0, true, 1 << 20}), (std::vector<survey::Box>{cells}));
  EXPECT_TRUE(active_blocks(cells, {&pyramid.bricks, 3, true, 1 << 20}).empty());
}

}  // namespace
}  // namespace footwall::isosurface
