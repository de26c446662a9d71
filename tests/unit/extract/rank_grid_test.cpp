#include "engine/comm/rank_grid.h"

#include <gtest/gtest.h>

namespace footwall::comm {
namespace {

TEST(RankGrid, EveryTraceHasOneOwnerWhateverTheCounts) {
  for (const survey::Index dims :
       {survey::Index{1, 1, 1}, {10, 3, 5}, {7, 13, 2}, {1, 100, 4}, {64, 64, 1}}) {
    for (int ranks = 1; ranks <= 24; ++ranks) {
      const RankGrid grid(dims, ranks);
      ASSERT_EQ(grid.ranks(), ranks);
      std::int64_t voxels = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const survey::Box box = grid.box(rank);
        voxels += box.count();
        if (box.empty()) continue;
        EXPECT_EQ(box.size(2), dims[2]);
        for (const survey::Index& corner :
             {box.lo, survey::Index{box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1}}) {
          EXPECT_EQ(grid.owner(corner), rank);
        }
      }
      EXPECT_EQ(voxels, dims[0] * dims[1] * dims[2]) << ranks;
    }
  }
}

TEST(RankGrid, InterleavedPillarsCoverTheSurveyOnce) {
  for (const int ranks : {1, 2, 3, 4, 7, 8}) {
    for (const std::array<int, 2> pillars : {std::array{2, 2}, std::array{1, 3}, std::array{5, 4}}) {
      const survey::Index dims{11, 13, 3};
      const RankGrid grid(dims, ranks, pillars);
      std::int64_t voxels = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        for (const survey::Box& box : grid.boxes(rank)) {
          EXPECT_FALSE(box.empty());
          voxels += box.count();
          for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
            for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) EXPECT_EQ(grid.owner({i, j, 1}), rank);
          }
        }
      }
      EXPECT_EQ(voxels, dims[0] * dims[1] * dims[2]);
    }
  }
  EXPECT_EQ(RankGrid({100, 100, 10}, 6).distance(0, 5), 3);
}

TEST(RankGrid, PartsAreAsSquareAsTheSurveyAllows) {
  EXPECT_EQ(RankGrid({100, 100, 10}, 4).parts(), (std::array<int, 2>{2, 2}));
  EXPECT_EQ(RankGrid({1000, 10, 10}, 4).parts(), (std::array<int, 2>{4, 1}));
  EXPECT_EQ(RankGrid({3, 100, 10}, 7).parts(), (std::array<int, 2>{1, 7}));
}

}  // namespace
}  // namespace footwall::comm
