// Messages between two partners that know of each other but not how much there is to say.
#pragma once
#include "engine/comm/communicator.h"

namespace footwall::render {

// Sends `mine` and returns what the partner sends: a message of 8 bytes each way with the size, then the
// bytes, in no message where there are none.
comm::Bytes swap_with(comm::Communicator& world, int partner, const comm::Bytes& mine);
// One way only; both count as above.
void give_to(comm::Communicator& world, int partner, const comm::Bytes& mine);
comm::Bytes take_from(comm::Communicator& world, int partner);
// What each of the ranks 1 .. senders - 1 gives, on rank 0, in the order of ranks. All of those call it.
std::vector<comm::Bytes> gather_to_first(comm::Communicator& world, int senders, const comm::Bytes& mine);

}  // namespace footwall::render
