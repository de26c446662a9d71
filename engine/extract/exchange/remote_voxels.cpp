#include "engine/extract/exchange/remote_voxels.h"

#include "storage/base/log.h"

namespace footwall::extract {

RemoteVoxels::RemoteVoxels(const comm::RankGrid& grid, const Blocks& blocks, int rank)
    : cache_(grid, blocks), sent_(grid, rank) {}

Outcome RemoteVoxels::run(const ExchangeStrategy& strategy, const Setup& setup) {
  try {
    cache_.begin_extraction();
    sent_.begin_extraction();
    Outcome outcome = strategy.run(setup);
    outcome.cache_hits = cache_.hits();
    sent_.trim(setup.options.cache_bytes);
    if (cache_.trim(setup.options.cache_bytes) && !told_of_the_limit_) {
      told_of_the_limit_ = true;
      log::info("rank " + std::to_string(setup.world.rank()) +
                ": one extraction alone needs more voxels of other ranks than the cache's limit of " +
                std::to_string(setup.options.cache_bytes >> 20) +
                " MiB holds; it works, and moves them again the next time");
    }
    outcome.cache_voxels = cache_.voxels();
    return outcome;
  } catch (...) {
    forget();
    throw;
  }
}

void RemoteVoxels::forget() {
  cache_.clear();
  sent_.clear();
}

}  // namespace footwall::extract
