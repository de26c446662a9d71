// The rates of the machine that these ranks run on.
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "engine/extract/cost/rates.h"

namespace footwall::extract {

// Read from `folder` (cost/rates_file.h) where they are there for rank 0's host, this MPI library and these
// ranks; else measured in about 0.2 s and kept there. Of the slowest rank; the same on every rank.
// Collective; throws kMemory, kEngine.
MachineRates machine_rates(const comm::Communicator& world, const std::filesystem::path& folder);
// Measured in any case, and kept.
MachineRates measured_rates(const comm::Communicator& world, const std::filesystem::path& folder);

}  // namespace footwall::extract
