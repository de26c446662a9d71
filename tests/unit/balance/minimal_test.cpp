#include "engine/extract/balance/minimal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/extract/balance/balance.h"
#include "engine/extract/replay/replay.h"
#include "rounds.h"
#include "unit/balance/benchmark_faces.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

const Choice kMinimal{"minimal", {}};

std::int64_t total(std::span<const std::int64_t> list) {
  return std::accumulate(list.begin(), list.end(), std::int64_t{0});
}

// Loads in voxels as counted, not as estimated.
void check_evenness(const Benchmark& benchmark, std::span<const Face> faces, int ranks) {
  SCOPED_TRACE(fmt::format("{} faces, {} ranks", faces.size(), ranks));
  const comm::RankGrid grid(benchmark.dims, ranks);
  const Pieces pieces = pieces_of(grid, faces);
  const double mean = static_cast<double>(total(pieces.voxels)) / ranks;
  const double largest = static_cast<double>(*std::max_element(pieces.voxels.begin(), pieces.voxels.end()));
  const MinimalMoves estimated = minimal_moves({grid, faces, kMinimal, {}});
  const MinimalMoves counted = minimal_moves({grid, faces, kMinimal, {}, pieces.voxels});
  for (const MinimalMoves* moves : {&estimated, &counted}) {
    EXPECT_LE(moves->moved, moves->least);
    EXPECT_TRUE(moves->moved == 0 || moves->gain > moves->cost);
    const Amounts amounts = amounts_of(grid, faces, pieces, moves->responsible);
    if (static_cast<double>(faces.size()) >= 30.0 * ranks) {
      EXPECT_LE(amounts.voxels_max_over_mean, 1.02 + largest / mean);
    }
  }
}

TEST(Minimal, IsEvenOnTheBenchmarks) {
  const bool all = rounds(1) > 1;
  for (const Benchmark& benchmark : kBenchmarks) {
    const std::vector<Face> faces =
        benchmark_faces(benchmark, all ? benchmark.faces : benchmark.faces / 10, 5);
    for (const int ranks :
         all ? std::vector<int>{2, 4, 8, 16, 32, 64, 128, 256} : std::vector<int>{2, 7, 16}) {
      check_evenness(benchmark, faces, ranks);
    }
  }
}

// With the balancer's own prices.
double seconds(const BalanceCosts& costs, const comm::RankGrid& grid, std::span<const Face> faces,
               const Pieces& pieces, std::span<const int> responsible) {
  constexpr double kPico = 1e-12;
  const Sent sent = sent_by(grid, faces, pieces, responsible, {"push", {}});
  const MachineCosts machine{static_cast<double>(costs.voxel) * kPico,
                             static_cast<double>(costs.remote) * kPico / 4,
                             static_cast<double>(costs.message) * kPico};
  return predict(amounts_of(grid, faces, pieces, responsible), sent, machine).total();
}

TEST(Minimal, IsNeverSlowerThanNone) {
  std::mt19937_64 random(32);
  int moved = 0;
  int stayed = 0;
  for (int round = 0; round < rounds(40); ++round) {
    const survey::Index dims{20 + static_cast<std::int64_t>(random() % 60), 30, 20};
    const comm::RankGrid grid(dims, 2 + static_cast<int>(random() % 9));
    const std::vector<Face> faces = random_faces(dims, 1 + static_cast<int>(random() % 200), random);
    const Pieces pieces = pieces_of(grid, faces);
    BalanceCosts costs;
    costs.voxel = 500 + static_cast<std::int64_t>(random() % 20000);
    costs.remote = 200 + static_cast<std::int64_t>(random() % 8000);
    costs.message = static_cast<std::int64_t>(random() % 400000);
    const MinimalMoves moves = minimal_moves({grid, faces, kMinimal, {}, pieces.voxels, nullptr, costs});
    (moves.moved > 0 ? moved : stayed) += 1;
    const std::vector<int> none = balance_strategy("none").run({grid, faces, kMinimal, {}});
    EXPECT_LE(seconds(costs, grid, faces, pieces, moves.responsible),
              seconds(costs, grid, faces, pieces, none) * (1 + 1e-12))
        << "round " << round;
  }
  EXPECT_GT(moved, 5);
  EXPECT_GT(stayed, 5);
}

TEST(Minimal, LeavesFacesWhereMovingDoesNotPay) {
  const Benchmark& benchmark = kBenchmarks[0];
  const std::vector<Face> faces = benchmark_faces(benchmark, 480, 6);
  const comm::RankGrid grid(benchmark.dims, 8);
  BalanceCosts costs;
  costs.message = 1'000'000'000'000;  // a second
  const MinimalMoves once = minimal_moves({grid, faces, kMinimal, {}, {}, nullptr, costs});
  EXPECT_EQ(once.moved, 0);
  EXPECT_EQ(once.responsible, balance_strategy("none").run({grid, faces, kMinimal, {}}));
  costs.horizon = 1'000'000;  // many extractions of the same faces
  EXPECT_GT(minimal_moves({grid, faces, kMinimal, {}, {}, nullptr, costs}).moved, 0);
}

TEST(Minimal, PrefersRanksThatHaveTheVoxels) {
  const comm::RankGrid grid({160, 16, 8}, 10);  // side by side along inlines
  std::vector<Face> faces;
  for (int n = 0; n < 300; ++n) {
    const std::int32_t j = 256 * (n % 5);
    faces.push_back({1, 1, n, {{{256, j, 256}, {256 * 9, j, 256}, {256, j + 256 * 8, 1024}}}});
  }
  CacheDirectory cache(grid);
  cache.add(std::span(faces).first(1), std::vector<int>{9});
  BalanceCosts costs;
  costs.message = 0;
  const std::vector<int> cold = minimal_moves({grid, faces, kMinimal, {}, {}, nullptr, costs}).responsible;
  const std::vector<int> warm = minimal_moves({grid, faces, kMinimal, {}, {}, &cache, costs}).responsible;
  const auto moved_first = [&](const std::vector<int>& ranks) {
    return *std::find_if(ranks.begin(), ranks.end(), [](int rank) { return rank != 0; });
  };
  EXPECT_EQ(moved_first(cold), 1);  // the neighbour
  EXPECT_EQ(moved_first(warm), 9);
}

TEST(Minimal, TakesUglyInputs) {
  const comm::RankGrid grid({1, 1, 1}, 7);
  EXPECT_TRUE(minimal_moves({grid, {}, kMinimal, {}}).responsible.empty());
  const std::vector<Face> one{{1, 1, 1, {}}};
  EXPECT_EQ(minimal_moves({grid, one, kMinimal, {}}).responsible, std::vector<int>{0});
}

}  // namespace
}  // namespace footwall::extract
