#include "engine/isosurface/visible/paper/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace footwall::isosurface {
namespace {

std::vector<PlacedWork> random_cells(int count, std::int64_t most_work, unsigned seed) {
  std::mt19937 random(seed);
  const auto to = [&](std::int64_t last) {
    return std::uniform_int_distribution<std::int64_t>(0, last)(random);
  };
  std::vector<PlacedWork> cells;
  for (int n = 0; n < count; ++n) {
    const int x = static_cast<int>(to(900));
    const int y = static_cast<int>(to(500));
    cells.push_back(
        {{x, y, x + 1 + static_cast<int>(to(30)), y + 1 + static_cast<int>(to(30))}, to(most_work)});
  }
  return cells;
}

std::vector<std::int64_t> work_of_ranks(const std::vector<PlacedWork>& cells, const std::vector<int>& rank_of,
                                        int ranks) {
  std::vector<std::int64_t> work(static_cast<std::size_t>(ranks));
  for (std::size_t n = 0; n < cells.size(); ++n)
    work.at(static_cast<std::size_t>(rank_of[n])) += cells[n].work;
  return work;
}

TEST(Partition, GivesEveryRankItsShare) {
  const std::vector<PlacedWork> cells = random_cells(4000, 100, 1);
  for (const int ranks : {1, 2, 3, 4, 5, 6, 7, 16, 60}) {
    const std::vector<std::int64_t> work =
        work_of_ranks(cells, partition_picture(cells, 1000, 600, ranks), ranks);
    std::int64_t all = 0;
    for (const std::int64_t each : work) all += each;
    const double mean = static_cast<double>(all) / ranks;
    // At each of the cuts above a rank at most half of the largest cell is misplaced.
    for (const std::int64_t each : work)
      EXPECT_NEAR(static_cast<double>(each), mean, 100) << ranks << " ranks";
  }
}

TEST(Partition, CutsTheLongestSideAndKeepsTilesTogether) {
  const std::vector<PlacedWork> cells = random_cells(1000, 9, 2);
  const auto centre = [&](std::size_t n, int axis) {
    return axis == 0 ? cells[n].box.x0 + cells[n].box.x1 : cells[n].box.y0 + cells[n].box.y1;
  };
  const auto expect_cut = [&](int width, int height, int axis) {
    const std::vector<int> rank_of = partition_picture(cells, width, height, 2);
    int last_of_first = -1;
    int first_of_last = 1 << 20;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      if (rank_of[n] == 0) last_of_first = std::max(last_of_first, centre(n, axis));
      if (rank_of[n] == 1) first_of_last = std::min(first_of_last, centre(n, axis));
    }
    EXPECT_LE(last_of_first, first_of_last);
  };
  expect_cut(1000, 600, 0);
  expect_cut(600, 1000, 1);
}

TEST(Partition, ThreeRanksAreTwoAgainstOne) {
  // Nine equal cells in a row: six go to the lower two ranks, three to the last.
  std::vector<PlacedWork> cells;
  for (int n = 0; n < 9; ++n) cells.push_back({{10 * n, 0, 10 * n + 10, 10}, 7});
  EXPECT_EQ(partition_picture(cells, 90, 10, 3), (std::vector<int>{0, 0, 0, 1, 1, 1, 2, 2, 2}));
  // Level centres, as when one looks along an axis, can be parted, too.
  for (PlacedWork& cell : cells) cell.box = {0, 0, 10, 10};
  EXPECT_EQ(work_of_ranks(cells, partition_picture(cells, 90, 10, 3), 3),
            (std::vector<std::int64_t>{21, 21, 21}));
}

TEST(Partition, TakesMoreRanksThanCellsAndCellsWithoutWork) {
  EXPECT_TRUE(partition_picture({}, 10, 10, 5).empty());
  const std::vector<PlacedWork> one{{{2, 2, 4, 4}, 5}};
  const std::vector<int> rank_of = partition_picture(one, 10, 10, 7);
  ASSERT_EQ(rank_of.size(), 1U);
  EXPECT_GE(rank_of[0], 0);
  EXPECT_LT(rank_of[0], 7);
  const std::vector<PlacedWork> idle(12, PlacedWork{{2, 2, 4, 4}, 0});
  for (const int rank : partition_picture(idle, 10, 10, 3)) EXPECT_TRUE(rank >= 0 && rank < 3);
}

TEST(Partition, DealsLargeTilesToRanksThatHaveLittle) {
  const std::vector<std::int64_t> nothing(3);
  EXPECT_EQ(deal_tiles(std::vector<std::int64_t>{5, 5, 5}, nothing), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(deal_tiles(std::vector<std::int64_t>{0, 9, 0}, nothing), (std::vector<int>{1, 0, 2}));
  EXPECT_EQ(deal_tiles(std::vector<std::int64_t>{7, 9, 8}, std::vector<std::int64_t>{300, 200, 100}),
            (std::vector<int>{0, 2, 1}));
}

}  // namespace
}  // namespace footwall::isosurface
