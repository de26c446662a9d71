// Faces of overloaded ranks go to the nearest ranks with room.
// Based on: seed 004, section 4.3.3 (MANHATTAN-LOADBALANCE). Ranks in order; an overloaded one gives down to
// the mean + d, to the ranks at distance 1, 2, ... tau of its rank coordinates (within a ring by rank), each
// of which takes, if it is below the mean, up to the mean + d; largest faces that fit first, ties by id.
#pragma once
#include <vector>

#include "engine/extract/balance/balance.h"

namespace footwall::extract {

// Parameters: d in voxel^2 (0), tau >= 1 (infinite).
std::vector<int> balance_manhattan(const BalanceInput& input);
void check_manhattan(const Choice& choice);

}  // namespace footwall::extract
