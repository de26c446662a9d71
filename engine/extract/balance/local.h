// A face of an overloaded centroid rank goes to the least loaded rank that has voxels near it.
// Based on: seed 004, section 4.3.2 (LOCAL-LOADBALANCE). Faces by id, with loads that run from 0; where the
// centroid rank's is above the mean + d, the least loaded rank whose box meets the face's bounding box takes
// it (ties: the centroid's rank, then by rank). The face's bounding box is that of its voxels. Differs in
// that a face which keeps its rank counts from the start, and in `cache`.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/extract/balance/balance.h"

namespace footwall::extract {

enum class LocalMean : std::uint8_t {
  kFinal,   // total area / ranks, as the seed's pseudocode has it
  kRunning  // of the faces met so far, as its prose has it
};

// Parameters: d in voxel^2 (0); "cache": ranks that have received voxels near the face (BalanceInput::cache)
// may take it too.
std::vector<int> balance_local(const BalanceInput& input);
std::vector<int> balance_local(const BalanceInput& input, LocalMean mean);
void check_local(const Choice& choice);

}  // namespace footwall::extract
