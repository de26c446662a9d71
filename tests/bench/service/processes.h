// What processes of this machine used so far.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/service/resident_status.h"

namespace footwall::service {

// Processor seconds of each, user and system.
std::vector<double> processor_seconds(std::span<const RankFacts> ranks);
// Resident bytes of the one that has most.
std::int64_t most_memory(std::span<const RankFacts> ranks);

}  // namespace footwall::service
