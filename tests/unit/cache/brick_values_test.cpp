#include "engine/extract/cache/brick_values.h"

#include <gtest/gtest.h>

#include "engine/extract/cache/voxel_set.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

float value_of(const survey::Index& p) {
  return static_cast<float>(p[0] * 10000 + p[1] * 100 + p[2]);
}

Blocks filled(const comm::RankGrid& grid, int rank) {
  Blocks blocks(grid, rank);
  for (Block& block : blocks.all()) {
    std::vector<float> values;
    for (std::int64_t i = block.wanted().lo[0]; i < block.wanted().hi[0]; ++i) {
      for (std::int64_t j = block.wanted().lo[1]; j < block.wanted().hi[1]; ++j) {
        for (std::int64_t k = 0; k < block.wanted().hi[2]; ++k) values.push_back(value_of({i, j, k}));
      }
    }
    block.put(block.wanted(), values);
  }
  return blocks;
}

// Also where pillars of a rank meet inside a brick.
TEST(BrickValues, AreThoseOfTheCoordinatesInTheSameOrder) {
  const survey::Index dims{40, 36, 21};
  for (const std::array<int, 2> pillars : {std::array<int, 2>{1, 1}, std::array<int, 2>{2, 3}}) {
    for (int rank = 0; rank < 2; ++rank) {
      const comm::RankGrid grid(dims, 2, pillars);
      const Blocks blocks = filled(grid, rank);
      VoxelSet set({{0, 0, 0}, dims});
      std::int64_t n = 0;
      for (const survey::Box& box : grid.boxes(rank)) {
        set.add(survey::Box{{box.lo[0], box.lo[1] + n % 2, n}, {box.hi[0] - n % 3, box.hi[1], n + 9}});
        ++n;
      }
      const BrickList list = set.list();
      const auto count = static_cast<std::size_t>(voxels_in(list));
      ASSERT_GT(count, 0U);
      std::vector<float> values(count);
      std::vector<float> again(count);
      std::vector<Coordinates> coordinates(count);
      gather(blocks, list, values);
      coordinates_of(list, coordinates);
      gather(blocks, coordinates, again);
      for (std::size_t v = 0; v < count; ++v) {
        EXPECT_EQ(values[v], value_of({coordinates[v][0], coordinates[v][1], coordinates[v][2]}));
        EXPECT_EQ(values[v], again[v]);
      }
      VoxelSet back({{0, 0, 0}, dims});
      back.add(bricks_of(coordinates));
      set.remove(back);
      EXPECT_TRUE(set.empty());
      EXPECT_EQ(back.count(), static_cast<std::int64_t>(count));
    }
  }
}

TEST(BrickValues, RefuseVoxelsOfOthersAndWrongOrder) {
  const comm::RankGrid grid({40, 36, 21}, 2);
  const Blocks blocks = filled(grid, 0);
  std::vector<float> value(1);
  const survey::Box other = grid.box(1);
  const std::vector<Coordinates> foreign{
      {static_cast<std::int32_t>(other.hi[0] - 1), static_cast<std::int32_t>(other.hi[1] - 1), 3}};
  EXPECT_THROW(gather(blocks, foreign, value), Error);
  const std::vector<Coordinates> outside{{-1, 0, 0}};
  EXPECT_THROW(gather(blocks, outside, value), Error);
  EXPECT_THROW(bricks_of(std::vector<Coordinates>{{1, 1, 1}, {1, 1, 1}}), Error);
  EXPECT_THROW(bricks_of(std::vector<Coordinates>{{2, 1, 1}, {1, 1, 2}}), Error);
  EXPECT_THROW(bricks_of(std::vector<Coordinates>{{1, 1, 9}, {1, 1, 2}}), Error);
}

}  // namespace
}  // namespace footwall::extract
