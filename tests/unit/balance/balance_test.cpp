#include "engine/extract/balance/balance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/extract/balance/area.h"
#include "engine/extract/balance/local.h"
#include "engine/extract/balance/none.h"
#include "engine/extract/registry.h"
#include "engine/verify/balance_by_pseudocode.h"
#include "engine/voxelize/exact.h"
#include "rounds.h"
#include "storage/base/error.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

std::vector<int> balanced(const std::string& text, const comm::RankGrid& grid, std::span<const Face> faces,
                          std::span<const int> previous = {}, const CacheDirectory* cache = nullptr) {
  const Choice choice = parse_choice(text);
  const BalanceStrategy& strategy = balance_strategy(choice.name);
  strategy.check(choice);
  return strategy.run({grid, faces, choice, previous, {}, cache, {}});
}

verify::BalanceCase case_of(const comm::RankGrid& grid, std::span<const Face> faces,
                            const std::vector<int>& previous, double d) {
  verify::BalanceCase made{grid.ranks(),
                           fixed_areas(faces),
                           balanced("none", grid, faces, previous),
                           {},
                           static_cast<std::int64_t>(d * kAreaPerVoxel2)};
  for (const int rank : previous) made.fixed.push_back(rank >= 0);
  return made;
}

bool meets(const comm::RankGrid& grid, int rank, const Face& face) {
  const survey::Box box = voxelize::bounding_voxels(face.triangle);
  const std::vector<survey::Box> boxes = grid.boxes(rank);
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const survey::Box& own) { return !survey::intersection(own, box).empty(); });
}

TEST(Balance, AgreesWithThePseudocode) {
  std::mt19937_64 random(11);
  const auto one_of = [&](const auto& list) { return list[random() % list.size()]; };
  int moved = 0;
  for (int round = 0; round < rounds(150); ++round) {
    const survey::Index dims =
        one_of(std::vector<survey::Index>{{40, 30, 20}, {7, 90, 5}, {3, 2, 9}, {1, 1, 1}});
    const int ranks = one_of(std::vector<int>{1, 2, 3, 4, 7, 16, 40});
    const auto pillars = one_of(std::vector<std::array<int, 2>>{{1, 1}, {1, 1}, {2, 2}, {3, 1}});
    const comm::RankGrid grid(dims, ranks, pillars);
    const std::vector<Face> faces = random_faces(dims, one_of(std::vector<int>{0, 1, 2, 20, 90}), random);
    std::vector<int> previous;
    if (round % 3 == 2) {
      for (std::size_t n = 0; n < faces.size(); ++n) {
        previous.push_back(random() % 2 == 0 ? -1
                                             : static_cast<int>(random() % static_cast<unsigned>(ranks)));
      }
    }
    const double d = one_of(std::vector<double>{0, 0, 0.25, 7, 60.5, 1e9});
    const int tau = one_of(std::vector<int>{-1, 1, 2, 5});
    const verify::BalanceCase given = case_of(grid, faces, previous, d);
    SCOPED_TRACE(
        fmt::format("round {}: {} faces, {} ranks, d {}, tau {}", round, faces.size(), ranks, d, tau));

    const std::vector<int> global = balanced(fmt::format("global={}", d), grid, faces, previous);
    EXPECT_EQ(global, verify::global_by_pseudocode(given));
    moved += global != given.start ? 1 : 0;
    const auto distance = [&](int a, int b) { return grid.distance(a, b); };
    const std::string manhattan =
        tau < 0 ? fmt::format("manhattan={}", d) : fmt::format("manhattan={},{}", d, tau);
    EXPECT_EQ(balanced(manhattan, grid, faces, previous),
              verify::manhattan_by_pseudocode(given, tau, distance));
    const auto near = [&](int rank, std::size_t face) { return meets(grid, rank, faces[face]); };
    const std::string local = fmt::format("local={}", d);
    EXPECT_EQ(balanced(local, grid, faces, previous), verify::local_by_pseudocode(given, near));
    const Choice choice = parse_choice(local);
    EXPECT_EQ(balance_local({grid, faces, choice, previous}, LocalMean::kRunning),
              verify::local_by_pseudocode(given, near, true));
  }
  EXPECT_GT(moved, 30);
}

TEST(Balance, IdsDecideAndNotTheOrderOfTheInput) {
  std::mt19937_64 random(12);
  const comm::RankGrid grid({40, 30, 20}, 7);
  const std::vector<Face> faces = random_faces({40, 30, 20}, 120, random);
  std::vector<std::size_t> order(faces.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Face> shuffled;
  for (const std::size_t n : order) shuffled.push_back(faces[n]);
  for (const BalanceStrategy& strategy : balance_strategies()) {
    const std::vector<int> ranks = balanced(std::string(strategy.name), grid, faces);
    const std::vector<int> again = balanced(std::string(strategy.name), grid, shuffled);
    for (std::size_t n = 0; n < order.size(); ++n) EXPECT_EQ(again[n], ranks[order[n]]) << strategy.name;
  }
}

TEST(Balance, UnchangedFacesKeepTheirRankAndEveryOtherGetsOne) {
  std::mt19937_64 random(13);
  const comm::RankGrid grid({40, 30, 20}, 4, {2, 2});
  const std::vector<Face> faces = random_faces({40, 30, 20}, 100, random);
  std::vector<int> previous(faces.size(), -1);
  for (std::size_t n = 0; n < faces.size(); n += 2) previous[n] = 3;  // all of them on one rank
  for (const BalanceStrategy& strategy : balance_strategies()) {
    const std::vector<int> ranks = balanced(std::string(strategy.name), grid, faces, previous);
    ASSERT_EQ(ranks.size(), faces.size());
    for (std::size_t n = 0; n < faces.size(); ++n) {
      if (previous[n] >= 0) {
        EXPECT_EQ(ranks[n], previous[n]) << strategy.name;
      }
      EXPECT_TRUE(ranks[n] >= 0 && ranks[n] < 4);
    }
  }
}

// A flat square of side x side voxels at (i, j), as half of it.
Face face_at(int n, int i, int j, int side) {
  return {1,
          1,
          n,
          {{{256 * i, 256 * j, 512}, {256 * (i + side), 256 * j, 512}, {256 * i, 256 * (j + side), 512}}}};
}

TEST(Balance, LocalMayUseRanksThatHaveReceivedTheVoxels) {
  const comm::RankGrid grid({64, 16, 8}, 4);  // side by side along inlines
  std::vector<Face> faces;
  for (int n = 0; n < 8; ++n) faces.push_back(face_at(n, 2, 2, 8));  // all inside rank 0
  EXPECT_EQ(balanced("local=0", grid, faces), std::vector<int>(8, 0));
  CacheDirectory cache(grid);
  EXPECT_EQ(balanced("local=0,cache", grid, faces, {}, &cache), std::vector<int>(8, 0));
  cache.add(std::span(faces).first(1), std::vector<int>{3});
  EXPECT_EQ(balanced("local=0,cache", grid, faces, {}, &cache), (std::vector<int>{0, 0, 0, 3, 3, 3, 0, 3}));
  EXPECT_EQ(balanced("local=0", grid, faces, {}, &cache), std::vector<int>(8, 0));
}

TEST(Balance, SaysWhichParametersItTakes) {
  for (const char* good : {"none", "minimal", "global", "global=2.5", "local", "local=3", "local=0,cache",
                           "manhattan", "manhattan=4", "manhattan=4,2"}) {
    const Choice choice = parse_choice(good);
    EXPECT_NO_THROW(balance_strategy(choice.name).check(choice)) << good;
  }
  for (const char* bad :
       {"none=1", "minimal=1", "global=-1", "global=x", "global=1,2", "local=1,sideways", "local=cache",
        "manhattan=1,0", "manhattan=1,1.5", "manhattan=1,2,3", "global=nan"}) {
    Options options;
    options.balance = bad;
    try {
      validate(options);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage) << bad;
      EXPECT_FALSE(error.hint().empty()) << bad;
    }
  }
}

}  // namespace
}  // namespace footwall::extract
