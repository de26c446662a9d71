#include "engine/extract/auto_choice.h"

#include <gtest/gtest.h>

#include "engine/extract/computations.h"
#include "engine/extract/registry.h"
#include "random_faces.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kDims{120, 100, 80};

// About what was measured on one machine, with as many cores as ranks.
MachineRates typical(int ranks) {
  MachineRates rates;
  rates.alpha = 1e-6;
  rates.overhead = 1e-6;
  rates.byte = 1e-10;
  rates.voxelize = 2e-9;
  rates.gather = 1.5e-8;
  rates.fold = 7e-9;
  rates.fold_discontinuity = 3e-8;
  rates.pack = 1e-8;
  rates.face = 2e-7;
  rates.finish = 1e-7;
  rates.balance = 1e-8;
  rates.ranks = ranks;
  rates.cores = ranks;
  return rates;
}

Chosen choice_for(const std::vector<Face>& faces, int ranks, const MachineRates& rates,
                  const Options& options = {}, const Chosen* incumbent = nullptr) {
  const comm::RankGrid grid(kDims, ranks);
  return choose({grid, faces, options, 0, incumbent}, rates);
}

// Cheap for each voxel: then nothing can be faster than folding where the voxels are.
Options moments_only() {
  Options options;
  options.compute = {"mean", "variance"};
  return options;
}

TEST(AutoChoice, LeavesWhatIsNamedAlone) {
  Options options;
  options.exchange = "minimum";
  options.balance = "none";
  EXPECT_FALSE(asks_for_choice(options));
  const Chosen chosen = choice_for(random_faces(kDims, 500, 30, 1), 4, typical(4), options);
  EXPECT_EQ(chosen.exchange, "minimum");
  EXPECT_EQ(chosen.balance, "none");
  EXPECT_EQ(chosen.reason, "");
  EXPECT_EQ(chosen.predicted.total, 0);
  EXPECT_EQ(chosen.looked_at, 0);
}

TEST(AutoChoice, SaysByNumbersThatSumsBeatVoxels) {
  const std::vector<Face> faces = random_faces(kDims, 2000, 30, 1);
  for (const int ranks : {2, 4, 7, 64}) {
    const Chosen chosen = choice_for(faces, ranks, typical(ranks), moments_only());
    EXPECT_EQ(chosen.exchange, "reduce") << ranks;
    EXPECT_GT(chosen.predicted.total, 0);
    EXPECT_NE(chosen.reason.find("ms predicted for 2000 faces"), std::string::npos) << chosen.reason;
  }
}

TEST(AutoChoice, FollowsTheMachine) {
  const std::vector<Face> faces = random_faces(kDims, 2000, 30, 1);
  // Where ending a sum took longer than sending its voxels, sums would not be worth it.
  MachineRates slow_sums = typical(4);
  slow_sums.finish = 1e-3;
  slow_sums.fold = 1e-6;
  EXPECT_NE(choice_for(faces, 4, slow_sums, moments_only()).exchange, "reduce");
}

// Named exchanges are kept, and only the balancer is chosen.
TEST(AutoChoice, BalancesACrowdWhereEachRankHasACore) {
  const std::vector<Face> crowd = random_faces(kDims, 4000, 24, 2, true);
  Options options;
  options.exchange = "minimum";
  const Chosen balanced = choice_for(crowd, 4, typical(4), options);
  EXPECT_EQ(balanced.exchange, "minimum");
  EXPECT_NE(balanced.balance, "none") << balanced.reason;
  EXPECT_GT(balanced.looked_at, 1);
  // All ranks on one core: who does the work does not matter, what moves does.
  MachineRates one_core = typical(4);
  one_core.cores = 1;
  EXPECT_EQ(choice_for(crowd, 4, one_core, options).balance, "none");
  // Moving is dear: all stays.
  MachineRates slow_link = typical(4);
  slow_link.byte = 1e-4;
  const Chosen stays = choice_for(crowd, 4, slow_link, options);
  EXPECT_EQ(stays.balance, "none") << stays.reason;
}

TEST(AutoChoice, DoesNotLookLongerThanItMayGain) {
  Options options;
  options.exchange = "minimum";
  const std::vector<Face> crowd = random_faces(kDims, 4000, 24, 2, true);
  MachineRates slow_balancers = typical(4);
  slow_balancers.balance = 1e-3;
  const Chosen chosen = choice_for(crowd, 4, slow_balancers, options);
  EXPECT_EQ(chosen.balance, "none");
  EXPECT_EQ(chosen.looked_at, 1);
  EXPECT_EQ(choice_for(random_faces(kDims, 50, 24, 2, true), 4, typical(4), options).looked_at, 1);
}

TEST(AutoChoice, GivesUpWhatRunsOnlyForMuchBetter) {
  const std::vector<Face> faces = random_faces(kDims, 2000, 30, 1);
  const Options options = moments_only();
  const Chosen reduce = choice_for(faces, 4, typical(4), options);
  Chosen push = reduce;
  push.exchange = "push";
  push.balance = "none";
  EXPECT_EQ(choice_for(faces, 4, typical(4), options, &push).exchange, "reduce");
  // Folding is made as slow as the rest, little by little: near the point where they cross, what runs stays,
  // whichever it is.
  int stays = 0;
  for (int percent = 100; percent < 1000; percent += 5) {
    MachineRates rates = typical(4);
    rates.fold *= percent / 100.0;
    const Chosen from_push = choice_for(faces, 4, rates, options, &push);
    const Chosen from_reduce = choice_for(faces, 4, rates, options, &reduce);
    if (from_push.exchange == "push" && from_reduce.exchange == "reduce") ++stays;
    EXPECT_FALSE(from_push.exchange == "reduce" && from_reduce.exchange == "push") << percent;
  }
  EXPECT_GT(stays, 0);
}

TEST(AutoChoice, OneRankAndNoFacesNeedNoModel) {
  const Chosen alone = choice_for(random_faces(kDims, 100, 30, 1), 1, {});
  EXPECT_EQ(alone.exchange, "reduce");
  EXPECT_EQ(alone.balance, "none");
  EXPECT_EQ(alone.predicted.total, 0);
  EXPECT_EQ(choice_for({}, 4, typical(4)).balance, "none");
}

// What needs the voxels of a face is never given to an exchange that moves none.
TEST(AutoChoice, NeverReducesWhatNeedsVoxels) {
  for (const Computation& computation : computations()) {
    if (computation.make == nullptr || !computation.built) continue;
    Options options;
    options.compute = {"mean", std::string(computation.name)};
    options.snr = 40;
    for (const int ranks : {1, 4})
      EXPECT_NE(choice_for(random_faces(kDims, 300, 30, 1), ranks, typical(ranks), options).exchange,
                "reduce");
  }
}

// Everything that may be chosen runs, and a choice is always a name that options may carry.
TEST(AutoChoice, IsAlwaysSomethingThatRuns) {
  for (const int ranks : {1, 2, 3, 7, 16}) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{30}, std::size_t{1000}}) {
      const Chosen chosen = choice_for(random_faces(kDims, count, 20, 4, true), ranks, typical(ranks));
      Options options;
      options.exchange = chosen.exchange;
      options.balance = chosen.balance;
      EXPECT_FALSE(asks_for_choice(options));
      EXPECT_NO_THROW(validate(options)) << chosen.exchange << " " << chosen.balance;
    }
  }
}

}  // namespace
}  // namespace footwall::extract
