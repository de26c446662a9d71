// As even a load as moving few voxels gives, and no move that does not pay.
// Loads are voxels (BalanceInput::voxels, else estimated), not areas. Overloaded ranks, the fullest first,
// give their largest faces that do not take them below the mean, until they are within a slack of it; so no
// more moves than has to, sum(max(0, load - mean)). A face goes to a rank with room that owns most traces
// near it, else to one that has received voxels near it, else to the nearest within two ranks' distance, else
// to the emptiest; where none has room, to the emptiest if that ends up below the giver. Afterwards the
// largest load is at most mean + largest face. The threshold is automatic: of a few slacks the first is taken
// whose expected gain, horizon x the fall of the largest load x the cost of a voxel, exceeds what the moves
// add to the busiest rank's messages, counted pessimistically; where none does, all faces stay.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/extract/balance/balance.h"

namespace footwall::extract {

// No parameters. O(F + moves log F).
std::vector<int> balance_minimal(const BalanceInput& input);
void check_minimal(const Choice& choice);

// What it moved and why, for benches and logs.
struct MinimalMoves {
  std::vector<int> responsible;
  std::int64_t moved = 0;  // voxels
  std::int64_t least = 0;  // sum(max(0, load - mean)): an even load needs no less
  std::int64_t gain = 0;   // picoseconds over the horizon, as expected
  std::int64_t cost = 0;
};
MinimalMoves minimal_moves(const BalanceInput& input);

}  // namespace footwall::extract
