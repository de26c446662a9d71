// The inside of LoadedSurvey: for the driver and for incremental extraction alone.
#pragma once
#include "engine/extract/blocks.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/extract.h"
#include "engine/extract/gather.h"
#include "engine/extract/plan.h"
#include "engine/extract/report.h"

namespace footwall::extract {

struct LoadedSurvey::State {
  // Collective.
  State(const comm::Communicator& parent, const comm::RankGrid& its_grid)
      : grid(its_grid),
        world(parent, grid),
        blocks(world.collectively([&] { return Blocks(grid, world.rank()); })) {
    world.collectively([&] {
      cache = std::make_unique<VoxelCache>(grid, blocks);
      sent = std::make_unique<SentRecord>(grid, world.rank());
    });
  }

  void forget_cache() {
    cache->clear();
    sent->clear();
  }

  comm::RankGrid grid;
  comm::Communicator world;
  Blocks blocks;
  std::unique_ptr<VoxelCache> cache;
  std::unique_ptr<SentRecord> sent;
  Kept kept;
  Gather gather;
  double read_seconds = 0;  // of this rank
  bool told_of_the_limit = false;
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
