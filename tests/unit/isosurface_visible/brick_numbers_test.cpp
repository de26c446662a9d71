#include "engine/isosurface/visible/brick_numbers.h"

#include <gtest/gtest.h>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/case_tables.h"
#include "storage/base/error.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

TEST(BrickNumbers, NoCellHasMoreTrianglesThanItsRoom) {
  std::size_t most = 0;
  for (const Pattern& pattern : tables::kPatterns) most = std::max(most, pattern.triangles.size());
  EXPECT_EQ(most, kMostTrianglesOfCell);
}

TEST(BrickNumbers, AscendAsTheWholeSurfacesTriangles) {
  const SampleVolume volume = random_volume({30, 19, 26}, 5);
  const BrickRanges ranges = brick_ranges(volume.field(), 1);
  const Bricks bricks = ranges.tables();
  std::vector<PartRun> runs;
  ExtractOptions options;
  options.bricks = &bricks;
  options.part_runs = &runs;
  Surface surface;
  extract(volume.field(), 0.9F, options, surface);
  const BrickNumbers numbers(bricks, 0.9F);
  ASSERT_GT(runs.size(), 100U);
  for (std::size_t n = 1; n < runs.size(); ++n) {
    const std::uint64_t end =
        numbers.first_of(runs[n - 1]) + (runs[n].first_triangle - runs[n - 1].first_triangle);
    ASSERT_LE(end, numbers.first_of(runs[n])) << n;
  }
}

TEST(BrickNumbers, RefuseMoreThanFit) {
  BrickRanges ranges;
  ranges.dims = {100, 100, 70};
  ranges.min.assign(700000, -1);
  ranges.max.assign(700000, 1);
  EXPECT_THROW(BrickNumbers(ranges.tables(), 0), Error);
  ranges.min[5] = 1;
  for (std::size_t n = 0; n < 2000; ++n) ranges.min[n] = 1;
  EXPECT_NO_THROW(BrickNumbers(ranges.tables(), 0));
}

}  // namespace
}  // namespace footwall::isosurface
