// Numbers in one order for things that are spread over ranks: every rank says how many it has in which slots,
// and learns the number of the first of them.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/comm/communicator.h"

namespace footwall::isosurface {

struct Run {
  std::uint64_t slot = 0;
  std::uint32_t count = 0;
  std::uint64_t first = 0;  // set by number_runs()
};

// Things are numbered from 0 by ascending slot. Runs ascend by slot; those of one slot must be of one rank
// and are numbered in their order. slots: of all, alike on all ranks. Returns the number of all things.
// Collective; memory: 32 MiB at most, however many slots there are.
std::uint64_t number_runs(const comm::Communicator& world, std::uint64_t slots, std::vector<Run>& runs);

}  // namespace footwall::isosurface
