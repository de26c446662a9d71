// The load balancing of seed 004, chapter 4, line by line as its pseudocode has it, slow and obvious: what
// engine/extract/balance is compared with. Plain values only.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

namespace footwall::verify {

struct BalanceCase {
  int ranks = 1;
  std::vector<std::int64_t> areas;  // of the faces, in the order of their ids
  std::vector<int> start;           // their centroid ranks
  std::vector<bool> fixed;          // those that keep their rank; empty: none
  std::int64_t threshold = 0;       // d
};

// GLOBAL-LOADBALANCE. Line 11: the largest faces that fit first, by id among equals; faces without area stay.
std::vector<int> global_by_pseudocode(const BalanceCase& given);

// MANHATTAN-LOADBALANCE; distance(i, j) of ranks; tau < 0 is infinite. Within a ring by rank.
std::vector<int> manhattan_by_pseudocode(const BalanceCase& given, int tau,
                                         const std::function<int(int, int)>& distance);

// LOCAL-LOADBALANCE; meets(rank, face): C_i intersects the bounding volume of F (face by its place).
// running: compares with the mean of the faces met so far, as the prose has it. Fixed faces count from the
// start.
std::vector<int> local_by_pseudocode(const BalanceCase& given,
                                     const std::function<bool(int, std::size_t)>& meets,
                                     bool running = false);

}  // namespace footwall::verify
