// footwall-engine check: do the ranks work together on this machine?
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"

namespace footwall::app {

// Collective. An allreduce, the versions of every rank's libraries, a parallel HDF5 file in `folder`. Rank 0
// prints one line of JSON on standard output (engine/session/self_check.h). Where parallel HDF5 fails it says
// so in the line; throws where the ranks do not reach each other.
void check(const comm::Communicator& world, const std::filesystem::path& folder);

}  // namespace footwall::app
