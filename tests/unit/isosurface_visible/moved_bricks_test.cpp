#include "engine/isosurface/visible/detail/moved_bricks.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

TEST(MovedBricks, MovesMakeLoadsEven) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::int64_t> work(1 + random() % 9);
    for (std::int64_t& load : work) load = random() % 3 == 0 ? 0 : static_cast<std::int64_t>(random() % 5000);
    const std::int64_t all = std::accumulate(work.begin(), work.end(), std::int64_t{0});
    std::vector<std::int64_t> after = work;
    for (const Move& move : moves_for(work, 0)) {
      ASSERT_GT(move.work, 0);
      ASSERT_NE(move.from, move.to);
      after[static_cast<std::size_t>(move.from)] -= move.work;
      after[static_cast<std::size_t>(move.to)] += move.work;
    }
    const auto ranks = static_cast<std::int64_t>(work.size());
    for (const std::int64_t load : after) {
      ASSERT_GE(load, all / ranks);
      ASSERT_LE(load, (all + ranks - 1) / ranks);
    }
  }
  EXPECT_TRUE(moves_for(std::vector<std::int64_t>{101, 99}, 0.02).empty());
  EXPECT_FALSE(moves_for(std::vector<std::int64_t>{105, 95}, 0.02).empty());
  EXPECT_TRUE(moves_for(std::vector<std::int64_t>{0, 0, 0}, 0.02).empty());
}

TEST(MovedBricks, RefuseMessagesThatAreNotWhole) {
  EXPECT_TRUE(taken_from({}, {20, 20, 20}).empty());
  std::vector<std::byte> message(40);
  EXPECT_THROW(taken_from(message, {20, 20, 20}), Error);
  message.resize(3);
  EXPECT_THROW(taken_from(message, {20, 20, 20}), Error);
}

}  // namespace
}  // namespace footwall::isosurface::detail
