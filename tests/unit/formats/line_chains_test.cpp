#include "storage/formats/detail/line_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

namespace footwall::formats::detail {
namespace {

using Chains = std::vector<std::vector<std::size_t>>;

TEST(LineChains, SegmentsInAnyOrderAndDirectionMakeOneChain) {
  EXPECT_EQ(line_chains(0, 4, {{2, 1}, {3, 2}, {0, 1}}), (Chains{{0, 1, 2, 3}}));
  EXPECT_EQ(line_chains(0, 4, {{3, 0}, {0, 2}, {2, 1}}), (Chains{{1, 2, 0, 3}}));
}

TEST(LineChains, ClosedChainsRepeatTheirFirstPoint) {
  EXPECT_EQ(line_chains(5, 9, {{5, 6}, {6, 7}, {7, 8}, {8, 5}}), (Chains{{5, 6, 7, 8, 5}}));
}

TEST(LineChains, AChainEndsWhereSegmentsBranch) {
  EXPECT_EQ(line_chains(0, 5, {{0, 1}, {1, 2}, {1, 3}, {3, 4}}), (Chains{{0, 1}, {1, 2}, {1, 3, 4}}));
}

TEST(LineChains, PointsWithoutSegmentsAreChainsOfOne) {
  EXPECT_EQ(line_chains(0, 3, {{0, 2}, {2, 0}}), (Chains{{0, 2}, {1}}));
  EXPECT_TRUE(line_chains(3, 3, {}).empty());
}

TEST(LineChains, EachSegmentIsUsedOnce) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 500; ++round) {
    const std::size_t points = 2 + random() % 12;
    std::vector<Segment> segments;
    std::map<std::pair<std::size_t, std::size_t>, int> expected, found;
    for (std::size_t n = random() % 20; n > 0; --n) {
      const Segment segment{random() % points, random() % points};
      if (segment.a == segment.b) continue;
      segments.push_back(segment);
      expected[std::minmax(segment.a, segment.b)] = 1;
    }
    std::vector<bool> seen(points, false);
    for (const auto& chain : line_chains(0, points, segments)) {
      for (std::size_t n = 0; n < chain.size(); ++n) {
        seen[chain[n]] = true;
        if (n > 0) ++found[std::minmax(chain[n - 1], chain[n])];
      }
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
  }
}

}  // namespace
}  // namespace footwall::formats::detail
