#include "engine/isosurface/parallel/pillars.h"

#include <gtest/gtest.h>

#include <map>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

struct Shape {
  survey::Index dims;
  int ranks;
  Interleaving interleaving;
};

const std::vector<Shape> kShapes{
    {{17, 13, 9}, 1, {1, 1, 1}}, {{17, 13, 9}, 4, {2, 3, 1}}, {{5, 4, 6}, 7, {3, 3, 2}},
    {{2, 2, 2}, 4, {2, 2, 2}},   {{3, 100, 2}, 6, {1, 1, 1}}, {{1, 5, 5}, 3, {1, 1, 1}},
    {{9, 1, 5}, 2, {2, 2, 2}},   {{8, 8, 1}, 2, {1, 1, 1}},   {{40, 7, 33}, 6, {1, 5, 4}}};

TEST(Pillars, EveryCellIsInOnePillarAndKnowsItsRank) {
  for (const Shape& shape : kShapes) {
    const Pillars pillars(shape.dims, shape.ranks, shape.interleaving);
    std::map<survey::Index, int> rank_of;
    for (int rank = 0; rank < shape.ranks; ++rank) {
      for (const survey::Box& cells : pillars.of_rank(rank)) {
        ASSERT_FALSE(cells.empty());
        for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
          for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
            for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
              ASSERT_TRUE(rank_of.emplace(survey::Index{i, j, k}, rank).second);
              ASSERT_EQ(pillars.owner({i, j, k}), rank);
            }
          }
        }
      }
    }
    const std::int64_t cells = (shape.dims[0] - 1) * (shape.dims[1] - 1) * (shape.dims[2] - 1);
    EXPECT_EQ(static_cast<std::int64_t>(rank_of.size()), cells);
  }
}

TEST(Pillars, PiecesDifferByOneCellAtMost) {
  const Pillars pillars({18, 24, 5}, 6, {2, 1, 1});
  std::int64_t least = 100;
  std::int64_t most = 0;
  for (const Pillar& pillar : pillars.all()) {
    least = std::min(least, pillar.cells.size(0));
    most = std::max(most, pillar.cells.size(0));
  }
  EXPECT_LE(most - least, 1);
}

// Seed 000, section 4: rank (i, j) processes the pillars (i + l CX, j + m CY).
TEST(Pillars, AreDealtOutInTurn) {
  const Pillars pillars({41, 41, 10}, 4, {2, 3, 1});
  ASSERT_EQ(pillars.grid(), (std::array<int, 2>{2, 2}));
  EXPECT_EQ(pillars.all().size(), 4U * 6U);
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 6; ++b) {
      EXPECT_EQ(pillars.rank_of({a, b, 0}), a % 2 * 2 + b % 2);
    }
  }
  EXPECT_EQ(pillars.of_rank(3).size(), 6U);
}

TEST(Pillars, ThoseAboveEachOtherGoToDifferentRanks) {
  const Pillars pillars({20, 20, 20}, 3, {1, 1, 3});
  EXPECT_NE(pillars.owner({0, 0, 0}), pillars.owner({0, 0, 10}));
  EXPECT_NE(pillars.owner({0, 0, 10}), pillars.owner({0, 0, 18}));
  EXPECT_EQ(pillars.layer(0), 0);
  EXPECT_EQ(pillars.layer(18), 2);
}

TEST(Pillars, StoreTheSamplesOfTheirCellsAndOneMoreAroundThem) {
  const Pillars pillars({11, 11, 11}, 2, {1, 1, 1});
  const survey::Box cells{{5, 0, 0}, {10, 10, 10}};
  EXPECT_EQ(pillars.samples_of(cells, false), (survey::Box{{5, 0, 0}, {11, 11, 11}}));
  EXPECT_EQ(pillars.samples_of(cells, true), (survey::Box{{4, 0, 0}, {11, 11, 11}}));
  // Two halves share one plane of samples; for gradients each holds one more of the other's.
  EXPECT_EQ(pillars.overlap_samples(false), 11 * 11);
  EXPECT_EQ(pillars.overlap_samples(true), 3 * 11 * 11);
  EXPECT_EQ(Pillars({1, 5, 5}, 2, {1, 1, 1}).overlap_samples(true), 0);
}

TEST(Pillars, InterleavingsAreReadAndRefused) {
  EXPECT_EQ(parse_interleaving("4x2"), (Interleaving{4, 2, 1}));
  EXPECT_EQ(parse_interleaving("4x2x3"), (Interleaving{4, 2, 3}));
  EXPECT_EQ(text_of({4, 2, 3}), "4x2x3");
  for (const char* bad : {"", "4", "4x", "0x1", "4x2x1x1", "1025x1", "axb", "4x-2"}) {
    EXPECT_THROW(parse_interleaving(bad), Error) << bad;
  }
}

}  // namespace
}  // namespace footwall::isosurface
