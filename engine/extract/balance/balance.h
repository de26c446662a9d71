// Who is responsible for which face. A strategy is one file in this folder and one row in strategies.cpp.
// Based on: seed 004, chapter 4. A rank's load is the area of the faces that it is responsible for; the mean
// is the total area / ranks; d, in voxel^2, is by how much a load may exceed the mean before the rank counts
// as overloaded.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/cache_directory.h"
#include "engine/extract/choice.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// What things cost, as far as a balancer weighs them, in picoseconds: whole numbers that must be the same on
// every rank (measured ones have to be agreed first). The ratio of the first two matters most.
struct BalanceCosts {
  std::int64_t voxel = 6000;       // voxelizing, looking up and folding one voxel
  std::int64_t remote = 2000;      // packing, sending and unpacking the value of one voxel
  std::int64_t message = 2000000;  // one message
  // Extractions for which the faces will probably stay as they are; what has to be sent for a move is then
  // sent once (see CacheDirectory), and its gain comes back each time.
  std::int64_t horizon = 1;
};

// What is known alike on every rank.
struct BalanceInput {
  const comm::RankGrid& grid;
  std::span<const Face> faces;
  const Choice& choice;  // the strategy with its parameters
  // The rank that was responsible for each face in the last extraction, -1 for a face that is new or has
  // changed; empty for a full extraction, which starts from the centroid ranks. A face with a rank here keeps
  // it: only the others are dealt out.
  std::span<const int> previous;
  // The number of voxels of each face inside the survey, where known; empty: estimated (voxel_weights.h).
  std::span<const std::int64_t> voxels = {};
  // What each rank has received of the others' voxels; null where nothing is kept.
  const CacheDirectory* cache = nullptr;
  BalanceCosts costs = {};
};

// The responsible rank of every face. No communication: every rank computes the same, whatever the order of
// the faces (their ids decide). Faces without area are never moved.
struct BalanceStrategy {
  std::string_view name;
  std::string_view help;
  std::vector<int> (*run)(const BalanceInput& input);
  void (*check)(const Choice& choice);  // throws kUsage for parameters that it does not take
};
std::span<const BalanceStrategy> balance_strategies();
// The one of a name of balance_rows().
const BalanceStrategy& balance_strategy(std::string_view name);

}  // namespace footwall::extract
