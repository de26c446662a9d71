// The cache of other ranks' voxels and the record of what they have, with the rules of an extraction: its
// beginning, its limit at the end, and that all is forgotten after an error.
#pragma once
#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

class RemoteVoxels {
 public:
  // `grid` and `blocks` must outlive it. Not collective; throws std::bad_alloc.
  RemoteVoxels(const comm::RankGrid& grid, const Blocks& blocks, int rank);

  // For Setup.
  VoxelCache& cache() { return cache_; }
  SentRecord& sent() { return sent_; }

  // Runs a strategy, whose setup has this cache and record; fills in the outcome's cache_hits and
  // cache_voxels. Collective, as the strategy; throws what it throws. A rank cannot be sure what the others
  // moved before an error, and every rank sees it, so that all forget.
  Outcome run(const ExchangeStrategy& strategy, const Setup& setup);
  // By convention every rank calls it.
  void forget();

 private:
  VoxelCache cache_;
  SentRecord sent_;
  bool told_of_the_limit_ = false;
};

}  // namespace footwall::extract
