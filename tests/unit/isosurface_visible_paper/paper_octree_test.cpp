#include <gtest/gtest.h>

#include "engine/isosurface/visible/paper/visible_paper.h"
#include "storage/base/error.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

TEST(PaperOctree, IsMadeOfBricksOrOfSamplesAlike) {
  const SampleVolume volume = random_volume({35, 1, 50}, 7, 0.4);
  const BrickRanges bricks = brick_ranges(volume.field(), 1);
  for (const survey::Index& cell : {survey::Index{8, 8, 8}, {16, 8, 24}, {64, 64, 64}, {5, 3, 9}}) {
    const Octree octree = paper_octree(volume.field(), bricks.tables(), cell, 1);
    const BrickRanges want = leaf_ranges(volume.field(), cell, 1);
    const Bricks got = octree.ranges(0);
    EXPECT_EQ(octree.leaf_cells(), cell);
    EXPECT_EQ(got.dims, want.dims);
    EXPECT_TRUE(std::equal(got.min.begin(), got.min.end(), want.min.begin(), want.min.end()));
    EXPECT_TRUE(std::equal(got.max.begin(), got.max.end(), want.max.begin(), want.max.end()));
    EXPECT_TRUE(
        std::equal(got.has_null.begin(), got.has_null.end(), want.has_null.begin(), want.has_null.end()));
  }
  EXPECT_THROW(paper_octree(volume.field(), bricks.tables(), {8, 0, 8}, 1), Error);
}

TEST(PaperOctree, HasAboutThirtyTwoCellsAlongEachAxis) {
  EXPECT_EQ(default_paper_cell({256, 256, 145}), (survey::Index{8, 8, 8}));
  EXPECT_EQ(default_paper_cell({512, 512, 617}), (survey::Index{16, 16, 24}));
  EXPECT_EQ(default_paper_cell({1, 1, 2}), (survey::Index{8, 8, 8}));
}

}  // namespace
}  // namespace footwall::isosurface
