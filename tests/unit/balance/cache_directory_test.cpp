#include "engine/extract/balance/cache_directory.h"

#include <gtest/gtest.h>

#include "engine/voxelize/exact.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

TEST(CacheDirectory, KnowsEveryCellThatWasReceivedAndLittleMore) {
  std::mt19937_64 random(21);
  const survey::Index dims{100, 70, 20};
  for (const std::array<int, 2> pillars : {std::array{1, 1}, std::array{2, 3}}) {
    const comm::RankGrid grid(dims, 6, pillars);
    CacheDirectory directory(grid);
    EXPECT_EQ(directory.cell(), 16);
    const std::vector<Face> faces = random_faces(dims, 40, random);
    std::vector<int> ranks;
    for (std::size_t n = 0; n < faces.size(); ++n) ranks.push_back(n % 5 == 4 ? -1 : static_cast<int>(n % 3));
    directory.add(faces, ranks);
    voxelize::ExactScratch scratch;
    for (std::size_t n = 0; n < faces.size(); ++n) {
      if (ranks[n] < 0) continue;
      for (const survey::Index& p : voxelize::list(faces[n].triangle, {{0, 0, 0}, dims}, scratch)) {
        if (grid.owner(p) == ranks[n]) continue;
        EXPECT_TRUE(directory.holds(ranks[n], {p, {p[0] + 1, p[1] + 1, p[2] + 1}}));
      }
    }
    for (int rank = 3; rank < 6; ++rank) EXPECT_FALSE(directory.holds(rank, {{0, 0, 0}, dims}));
    EXPECT_FALSE(directory.empty());
    directory.clear();
    EXPECT_TRUE(directory.empty());
    for (int rank = 0; rank < 6; ++rank) EXPECT_FALSE(directory.holds(rank, {{0, 0, 0}, dims}));
  }
}

TEST(CacheDirectory, LeavesOutWhatARankOwnsAndCellsBesideTheTriangle) {
  const comm::RankGrid grid({128, 128, 8}, 4);
  CacheDirectory directory(grid);
  const Face own{1, 1, 1, {{{0, 0, 0}, {256 * 50, 0, 0}, {0, 256 * 50, 0}}}};
  directory.add(std::span(&own, 1), std::vector<int>{0});
  EXPECT_TRUE(directory.empty());
  // Its bounding box is the whole survey, but it runs along the diagonal.
  const Face diagonal{1, 1, 2, {{{0, 0, 0}, {256 * 127, 256 * 127, 0}, {256 * 127, 256 * 126, 0}}}};
  directory.add(std::span(&diagonal, 1), std::vector<int>{0});
  EXPECT_TRUE(directory.holds(0, {{120, 120, 0}, {121, 121, 8}}));
  EXPECT_FALSE(directory.holds(0, {{96, 64, 0}, {112, 80, 8}}));
}

TEST(CacheDirectory, KeepsToItsMemoryWithLargerCells) {
  const comm::RankGrid grid({4000, 3000, 10}, 64);
  const CacheDirectory directory(grid, 4096);
  EXPECT_LE(directory.bytes(), 4096);
  EXPECT_GT(directory.cell(), 16);
  EXPECT_LE(CacheDirectory(comm::RankGrid({9, 9, 9}, 4), 0).bytes(), 32);
}

}  // namespace
}  // namespace footwall::extract
