// Faces of overloaded ranks go to any rank with room.
// Based on: seed 004, section 4.3.1 (GLOBAL-LOADBALANCE). Ranks in order; an overloaded one gives down to the
// mean, to the ranks below the mean by rising load (sorted once for each giver, ties by rank), each of which
// takes up to the mean: line 11's subset is the largest faces that fit first, ties by id.
#pragma once
#include <vector>

#include "engine/extract/balance/balance.h"

namespace footwall::extract {

// Parameter: d in voxel^2 (0).
std::vector<int> balance_global(const BalanceInput& input);
void check_global(const Choice& choice);

}  // namespace footwall::extract
