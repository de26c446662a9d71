#include "engine/extract/cache/voxel_cache.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "engine/extract/cache/brick_values.h"

namespace footwall::extract {
namespace {

const survey::Index kDims{40, 36, 21};

float value_of(const Coordinates& p) {
  return static_cast<float>(p[0] * 10000 + p[1] * 100 + p[2]);
}

// A receiver (rank 0 of 4) and what the others know of it.
struct Pairs {
  comm::RankGrid grid{kDims, 4};
  Blocks blocks{grid, 0};
  VoxelCache cache{grid, blocks};
  std::vector<std::unique_ptr<SentRecord>> sent;
  BrickOwners owners{grid};

  Pairs() {
    for (Block& block : blocks.all()) {
      std::vector<float> values(static_cast<std::size_t>(block.wanted().count()), -1);
      block.put(block.wanted(), values);
    }
    for (int rank = 0; rank < 4; ++rank) sent.push_back(std::make_unique<SentRecord>(grid, rank));
  }
  void begin() {
    cache.begin_extraction();
    for (auto& each : sent) each->begin_extraction();
  }
  bool trim(std::int64_t bytes) {
    for (auto& each : sent) each->trim(bytes);
    return cache.trim(bytes);
  }
  BrickList wanted_of(int owner, const survey::Box& box) const {
    VoxelSet set({{0, 0, 0}, kDims});
    set.add(box);
    BrickList list;
    set.for_each([&](const BrickMask& each) {
      const Mask mask = without(each.mask & owners.owned(owner, each.brick), owners.held(0, each.brick));
      if (!none(mask)) list.push_back({each.brick, mask});
    });
    return list;
  }
  // As push does it; returns how many voxels moved.
  std::int64_t move(int owner, const BrickList& wanted) {
    const BrickList by_owner = sent[static_cast<std::size_t>(owner)]->missing(0, wanted);
    const BrickList by_receiver = cache.missing(owner, wanted);
    EXPECT_EQ(voxels_in(by_owner), voxels_in(by_receiver));
    std::vector<Coordinates> coordinates(static_cast<std::size_t>(voxels_in(by_owner)));
    coordinates_of(by_owner, coordinates);
    std::vector<float> values;
    for (const Coordinates& p : coordinates) values.push_back(value_of(p));
    sent[static_cast<std::size_t>(owner)]->enter(0, by_owner);
    if (!by_receiver.empty()) cache.put(owner, by_receiver, values);
    return voxels_in(by_owner);
  }
  // Every voxel of the list has its value.
  void expect_here(const BrickList& list) {
    std::vector<Coordinates> coordinates(static_cast<std::size_t>(voxels_in(list)));
    coordinates_of(list, coordinates);
    for (const Coordinates& p : coordinates) {
      const float* brick = cache.brick({p[0] >> 3, p[1] >> 3, p[2] >> 3});
      ASSERT_NE(brick, nullptr);
      EXPECT_EQ(brick[(p[0] & 7) * 64 + (p[1] & 7) * 8 + (p[2] & 7)], value_of(p));
    }
  }
};

TEST(VoxelCache, SendersAndReceiverAgreeUnderAnyLimit) {
  for (const std::int64_t bricks : {0, 1, 7, 40}) {
    std::mt19937_64 random(3);
    Pairs pairs;
    const std::int64_t limit = bricks * kBytesPerBrick * 3;
    EXPECT_EQ(bricks_of_a_pair(limit, 4), bricks);
    for (int extraction = 0; extraction < 40; ++extraction) {
      pairs.begin();
      std::vector<BrickList> here;
      std::int64_t hits = 0;
      for (int owner = 1; owner < 4; ++owner) {
        const survey::Index p{static_cast<std::int64_t>(random() % 40),
                              static_cast<std::int64_t>(random() % 36),
                              static_cast<std::int64_t>(random() % 21)};
        const BrickList wanted = pairs.wanted_of(owner, survey::grown({p, p}, 6));
        hits += voxels_in(wanted) - pairs.move(owner, wanted);
        here.push_back(wanted);
      }
      for (const BrickList& list : here) pairs.expect_here(list);
      EXPECT_EQ(pairs.cache.hits(), hits);
      pairs.trim(limit);
      EXPECT_LE(pairs.cache.voxels(), bricks * 3 * kBrickVoxels);
    }
  }
}

TEST(VoxelCache, SaysWhenOneExtractionIsMoreThanTheLimit) {
  Pairs pairs;
  pairs.begin();
  pairs.move(3, pairs.wanted_of(3, {{0, 0, 0}, kDims}));
  EXPECT_FALSE(pairs.trim(std::int64_t{1} << 30));
  pairs.begin();
  EXPECT_FALSE(pairs.trim(9 * kBytesPerBrick));  // what goes is older
  pairs.begin();
  pairs.move(3, pairs.wanted_of(3, {{0, 0, 0}, kDims}));
  EXPECT_TRUE(pairs.trim(9 * kBytesPerBrick));
}

TEST(VoxelCache, ABrickOnTheBorderHasOwnVoxelsToo) {
  Pairs pairs;
  pairs.begin();
  const survey::Box own = pairs.grid.box(0);
  const survey::Box across{{own.hi[0] + 1, 3, 0}, {own.hi[0] + 2, 4, 1}};
  ASSERT_NE(own.hi[0] % 8, 0) << "the border must cut a brick";
  pairs.move(pairs.grid.owner(across.lo), pairs.wanted_of(pairs.grid.owner(across.lo), across));
  const float* brick = pairs.cache.brick({own.hi[0] >> 3, 0, 0});
  ASSERT_NE(brick, nullptr);
  for (std::int64_t i = own.hi[0] & ~std::int64_t{7}; i <= own.hi[0]; ++i)
    EXPECT_EQ(brick[(i & 7) * 64 + 3 * 8], -1);
}

TEST(VoxelCache, StartsAnewWhenCleared) {
  Pairs pairs;
  pairs.begin();
  const BrickList wanted = pairs.wanted_of(2, {{0, 0, 0}, kDims});
  const std::int64_t moved = pairs.move(2, wanted);
  EXPECT_EQ(pairs.move(2, wanted), 0);
  pairs.cache.clear();
  for (auto& each : pairs.sent) each->clear();
  EXPECT_EQ(pairs.cache.voxels(), 0);
  EXPECT_EQ(pairs.cache.brick({wanted.front().brick[0], wanted.front().brick[1], wanted.front().brick[2]}),
            nullptr);
  EXPECT_EQ(pairs.move(2, wanted), moved);
}

}  // namespace
}  // namespace footwall::extract
