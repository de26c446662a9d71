// How many ranks share this rank's host, and so its memory.
#pragma once
#include "engine/comm/communicator.h"

namespace footwall::session {

// At least 1. Collective.
int ranks_of_this_host(const comm::Communicator& world);

}  // namespace footwall::session
