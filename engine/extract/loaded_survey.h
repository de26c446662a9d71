// The inside of LoadedSurvey: for the driver and for incremental extraction alone.
#pragma once
#include "engine/extract/auto_choice.h"
#include "engine/extract/balance/cache_directory.h"
#include "engine/extract/blocks.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/exchange/remote_voxels.h"
#include "engine/extract/extract.h"
#include "engine/extract/gather.h"
#include "engine/extract/plan.h"
#include "engine/extract/report.h"

namespace footwall::extract {

struct LoadedSurvey::State {
  // Collective.
  State(const comm::Communicator& parent, const comm::RankGrid& its_grid, const JobContext& job)
      : grid(its_grid),
        world(parent, grid),
        blocks(world.collectively([&] { return Blocks(grid, world.rank(), job); })),
        remote(
            world.collectively([&] { return std::make_unique<RemoteVoxels>(grid, blocks, world.rank()); })),
        directory(world.collectively([&] { return CacheDirectory(grid); })) {}

  BalanceInput to_balance(const Plan& plan, std::span<const Face> faces, std::span<const int> previous,
                          const BalanceCosts& costs = {}) const {
    BalanceInput input{grid, faces, plan.balance, previous};
    input.costs = costs;
    if (plan.strategy->moves_voxels) input.cache = &directory;
    return input;
  }

  void forget_cache() {
    remote->forget();
    automatic.forget_cached();
    directory.clear();
  }

  comm::RankGrid grid;
  comm::Communicator world;
  Blocks blocks;
  std::optional<Options> validated;  // the last that were found good, for which `automatic` is prepared
  AutoChoice automatic;
  std::unique_ptr<RemoteVoxels> remote;
  CacheDirectory directory;  // which ranks have been sent what, roughly: for balancing
  Kept kept;
  Gather gather;
  double read_seconds = 0;  // of this rank
  Seconds own_seconds;      // of the last extraction, of this rank
};

// Steps 2 to 4 of EXTRACT-ALL for faces whose ranks are known, and the results at rank 0, unagreed; after
// gather.prepare() with these ranks and ran.faces.
struct Ran {
  Outcome outcome;
  std::vector<FaceStatistics> faces;  // at rank 0
  comm::Traffic traffic;              // of the exchange
};
// Collective. A failure of this rank alone is in the outcome, or was agreed upon and is thrown.
void run_exchange(LoadedSurvey::State& state, const Plan& plan, const Input& input,
                  std::span<const int> responsible, const JobContext& job, Ran& ran);

// What this rank has to tell of it, but for the seconds.
Tally tally_of(const Ran& ran);

}  // namespace footwall::extract
