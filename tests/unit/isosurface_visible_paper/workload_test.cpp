#include "engine/isosurface/visible/paper/workload.h"

#include <gtest/gtest.h>

#include "engine/isosurface/visible/octree.h"
#include "storage/base/error.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

// What an octree over smaller leaves has below a cell.
std::int64_t active_leaves(const Octree& octree, const survey::Box& cells, float isovalue) {
  std::int64_t count = 0;
  const survey::Index& dims = octree.dims(0);
  for (std::int64_t a = 0; a < dims[0]; ++a) {
    for (std::int64_t b = 0; b < dims[1]; ++b) {
      for (std::int64_t c = 0; c < dims[2]; ++c) {
        const Octree::Node leaf{0, {a, b, c}};
        count += cells.contains(octree.cells_of(leaf).lo) && octree.is_active(leaf, isovalue) ? 1 : 0;
      }
    }
  }
  return count;
}

TEST(Workload, CountsTheNodesBelowACell) {
  Workload workload;
  for (const double nulls : {0.0, 0.3}) {
    const SampleVolume volume = random_volume({19, 24, 140}, 3, nulls);
    for (const survey::Index& block : {survey::Index{1, 1, 1}, {2, 2, 2}, {4, 4, 4}, {8, 8, 8}, {2, 4, 1}}) {
      const BrickRanges leaves = leaf_ranges(volume.field(), block, 1);
      const Octree octree(leaves.tables(), volume.size, block);
      for (const float isovalue : {0.0F, 0.97F, 2.0F}) {
        for (const survey::Box& cells :
             {survey::Box{{0, 0, 0}, {8, 8, 8}}, survey::Box{{8, 16, 8}, {16, 23, 16}},
              survey::Box{{16, 8, 0}, {18, 16, 16}}, survey::Box{{0, 8, 8}, {8, 16, 139}}}) {
          EXPECT_EQ(workload.of(volume.field(), cells, isovalue, block),
                    active_leaves(octree, cells, isovalue));
        }
      }
    }
  }
}

TEST(Workload, CountsBlocksThatCutWordsUnevenly) {
  const SampleVolume volume = random_volume({6, 7, 150}, 4, 0.5);
  const survey::Box cells{{0, 0, 0}, {5, 6, 149}};
  Workload workload;
  for (const survey::Index& block :
       {survey::Index{1, 1, 3}, {5, 2, 7}, {3, 3, 31}, {32, 32, 32}, {2, 2, 5}}) {
    const BrickRanges leaves = leaf_ranges(volume.field(), block, 1);
    const Octree octree(leaves.tables(), volume.size, block);
    for (const float isovalue : {0.0F, 0.995F})
      EXPECT_EQ(workload.of(volume.field(), cells, isovalue, block), active_leaves(octree, cells, isovalue));
  }
  EXPECT_THROW(workload.of(volume.field(), cells, 0, {1, 1, 33}), Error);
  EXPECT_THROW(workload.of(volume.field(), cells, 0, {0, 1, 1}), Error);
}

TEST(Workload, IsNothingWithoutCells) {
  const SampleVolume volume = random_volume({4, 1, 4}, 3);
  EXPECT_EQ(Workload().of(volume.field(), {{0, 0, 0}, {3, 0, 3}}, 0, {1, 1, 1}), 0);
}

}  // namespace
}  // namespace footwall::isosurface
