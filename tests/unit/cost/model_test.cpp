#include "engine/extract/cost/model.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// Numbers that are easy to multiply by hand.
MachineRates round_rates() {
  MachineRates rates;
  rates.alpha = 1e-3;
  rates.overhead = 1e-4;
  rates.byte = 1e-6;
  rates.voxelize = 2e-6;
  rates.gather = 3e-6;
  rates.fold = 4e-6;
  rates.fold_discontinuity = 9e-6;
  rates.pack = 5e-6;
  rates.face = 1e-5;
  rates.finish = 1e-4;
  rates.balance = 1e-6;
  rates.ranks = 2;
  rates.cores = 2;
  return rates;
}

std::vector<RankAmounts> two_ranks() {
  std::vector<RankAmounts> ranks(2);
  ranks[0] = {.faces = 10,
              .voxels = 1000,
              .owned = 700,
              .owned_elsewhere = 100,
              .owned_faces = 12,
              .received = 300,
              .sent = 100,
              .blocks_received = {700, 1700},
              .blocks_sent = {250, 600},
              .bounding_received = 5000,
              .bounding_sent = 2000,
              .pieces_received = 4,
              .pieces_sent = 2,
              .partners_received = 1,
              .partners_sent = 1};
  ranks[1] = {.faces = 5,
              .voxels = 400,
              .owned = 700,
              .owned_elsewhere = 400,
              .owned_faces = 8,
              .received = 100,
              .sent = 300,
              .blocks_received = {250, 600},
              .blocks_sent = {700, 1700},
              .bounding_received = 2000,
              .bounding_sent = 5000,
              .pieces_received = 2,
              .pieces_sent = 4,
              .partners_received = 1,
              .partners_sent = 1};
  return ranks;
}

Seconds predicted(std::string_view exchange, const Workload& workload, const MachineRates& rates) {
  return predict(parse_choice(exchange), workload, rates);
}

constexpr double kTiny = 1e-12;

TEST(Model, MinimumIsEquation317) {
  const std::vector<RankAmounts> ranks = two_ranks();
  const Seconds seconds = predicted("minimum", {.ranks = ranks}, round_rates());
  EXPECT_NEAR(seconds.voxelize, 10 * 1e-5 + 1000 * 2e-6, kTiny);
  // Two rounds of sizes and contents; 16 bytes a voxel of the busiest. k (2 in + out) of the busiest is
  // computing.
  EXPECT_NEAR(seconds.exchange, 2 * (2e-3 + 2e-4) + 16 * 300 * 1e-6, kTiny);
  EXPECT_NEAR(seconds.compute, 1000 * 3e-6 + 10 * 1e-4 + 5e-6 * (2 * 300 + 100), kTiny);
  EXPECT_NEAR(seconds.total, seconds.voxelize + seconds.exchange + seconds.compute, kTiny);
}

TEST(Model, ABlockSendsItsSlab) {
  const std::vector<RankAmounts> ranks = two_ranks();
  EXPECT_NEAR(predicted("block=4", {.ranks = ranks}, round_rates()).exchange,
              2 * (2e-3 + 2e-4) + 16 * 1700 * 1e-6, kTiny);
  EXPECT_EQ(predicted("block=1", {.ranks = ranks}, round_rates()).exchange,
            predicted("minimum", {.ranks = ranks}, round_rates()).exchange);
  EXPECT_EQ(predicted("block", {.ranks = ranks}, round_rates()).exchange,
            predicted("block=2", {.ranks = ranks}, round_rates()).exchange);
}

TEST(Model, ABoundingVolumeTravelsWhileFacesAreVoxelized) {
  const std::vector<RankAmounts> ranks = two_ranks();
  MachineRates rates = round_rates();
  const double transfer = 1e-3 + 1e-4 + 16 * 5000 * 1e-6;
  const double voxelize = 10 * 1e-5 + 1000 * 2e-6;
  EXPECT_NEAR(predicted("bounding", {.ranks = ranks}, rates).exchange, transfer - voxelize, kTiny);
  rates.byte = 1e-12;
  rates.alpha = rates.overhead = 1e-9;
  const Seconds seconds = predicted("bounding", {.ranks = ranks}, rates);
  EXPECT_NEAR(seconds.exchange, 0, kTiny);
  EXPECT_NEAR(seconds.compute, 1000 * 3e-6 + 10 * 1e-4 + 5e-6 * 7000, kTiny);
}

TEST(Model, PushVoxelizesForOthersAndSendsValuesOnly) {
  const std::vector<RankAmounts> ranks = two_ranks();
  const Seconds seconds = predicted("push", {.ranks = ranks}, round_rates());
  EXPECT_NEAR(seconds.voxelize, (10 + 2) * 1e-5 + (1000 + 100) * 2e-6, kTiny);
  EXPECT_NEAR(seconds.exchange, 1e-3 + 1e-4 + 4 * 300 * 1e-6, kTiny);
  EXPECT_NEAR(seconds.compute, 1000 * 3e-6 + 10 * 1e-4 + 5e-6 * 400, kTiny);
}

TEST(Model, ReduceSendsSums) {
  const std::vector<RankAmounts> ranks = two_ranks();
  const Seconds seconds = predicted("reduce", {.ranks = ranks}, round_rates());
  EXPECT_NEAR(seconds.voxelize, 12 * 1e-5 + 700 * 4e-6, kTiny);
  EXPECT_NEAR(seconds.exchange, 1e-3 + 1e-4 + 56 * 4 * 1e-6, kTiny);
  EXPECT_NEAR(seconds.compute, 1e-4 * 10 + 1e-4 * 6, kTiny);
  EXPECT_NEAR(predicted("reduce", {.ranks = ranks, .discontinuity = true}, round_rates()).voxelize,
              12 * 1e-5 + 700 * 9e-6, kTiny);
}

TEST(Model, RanksOnOneCoreTakeTurns) {
  const std::vector<RankAmounts> ranks = two_ranks();
  MachineRates rates = round_rates();
  rates.cores = 1;
  EXPECT_NEAR(predicted("minimum", {.ranks = ranks}, rates).compute,
              1400 * 3e-6 + 15 * 1e-4 + 5e-6 * (2 * 300 + 100 + 2 * 100 + 300), kTiny);
  // And threads help as far as there are cores.
  rates.cores = 4;
  EXPECT_NEAR(predicted("minimum", {.ranks = ranks, .threads = 2}, rates).compute,
              (1000 * 3e-6 + 10 * 1e-4 + 5e-6 * (2 * 300 + 100)) / 2, kTiny);
}

TEST(Model, CachedVoxelsAreNotSentAgain) {
  const std::vector<RankAmounts> ranks = two_ranks();
  const Seconds fresh = predicted("push", {.ranks = ranks}, round_rates());
  const Seconds cached = predicted("push", {.ranks = ranks, .cached = 0.75}, round_rates());
  EXPECT_NEAR(fresh.exchange - cached.exchange, 0.75 * 4 * 300 * 1e-6, kTiny);
  EXPECT_NEAR(fresh.compute - cached.compute, 0.75 * 5e-6 * 400, kTiny);
}

TEST(Model, WholeFaceWorkCountsForEveryVoxelOfTheLoad) {
  const std::vector<RankAmounts> ranks = two_ranks();
  const Seconds without = predicted("push", {.ranks = ranks}, round_rates());
  const Seconds with = predicted("push", {.ranks = ranks, .whole_face = 1e-5}, round_rates());
  EXPECT_NEAR(with.compute - without.compute, 1000 * 1e-5, kTiny);
}

// More of anything never makes an extraction faster.
TEST(Model, IsMonotonous) {
  const MachineRates rates = round_rates();
  const std::vector<RankAmounts> base = two_ranks();
  for (const std::string_view exchange : {"minimum", "block=2", "block=4", "bounding", "push", "reduce"}) {
    const double before = predicted(exchange, {.ranks = base}, rates).total;
    for (double RankAmounts::*amount :
         {&RankAmounts::faces, &RankAmounts::voxels, &RankAmounts::owned, &RankAmounts::owned_elsewhere,
          &RankAmounts::received, &RankAmounts::sent, &RankAmounts::pieces_received,
          &RankAmounts::bounding_received}) {
      std::vector<RankAmounts> more = base;
      more[0].*amount *= 2;
      EXPECT_GE(predicted(exchange, {.ranks = more}, rates).total, before) << exchange;
    }
    for (double MachineRates::*rate : {&MachineRates::alpha, &MachineRates::overhead, &MachineRates::byte,
                                       &MachineRates::voxelize, &MachineRates::gather, &MachineRates::pack,
                                       &MachineRates::face, &MachineRates::finish, &MachineRates::fold}) {
      MachineRates slower = rates;
      slower.*rate *= 2;
      EXPECT_GE(predicted(exchange, {.ranks = base}, slower).total, before) << exchange;
    }
  }
}

TEST(Model, KnowsWhatItKnows) {
  EXPECT_TRUE(has_model(parse_choice("block=4")));
  EXPECT_FALSE(has_model(parse_choice("block=7")));
  EXPECT_FALSE(has_model(parse_choice("pigeon")));
  const std::vector<RankAmounts> ranks = two_ranks();
  EXPECT_THROW(predicted("pigeon", {.ranks = ranks}, round_rates()), Error);
}

}  // namespace
}  // namespace footwall::extract
