#include "engine/service/resident/doorbell.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "engine/service/resident/connect_host.h"

namespace footwall::service {
namespace {

constexpr int kRing = 1;  // a message's tag
constexpr std::chrono::milliseconds kPause(2);

}  // namespace

Doorbell::Doorbell(const comm::Communicator& world, const std::filesystem::path& folder,
                   const std::vector<int>& host_of)
    : world_(world.get()), hosts_(host_of, world.rank()) {
  connect_host(world_, hosts_, folder / fmt::format("doorbell-{}", hosts_.leader), leader_, member_);
}

void Doorbell::ring() {
  // The farthest first.
  for (const int leader : hosts_.other_leaders)
    comm::check(MPI_Send(nullptr, 0, MPI_BYTE, leader, kRing, world_.get()), "MPI_Send");
  leader_->send(0);
}

void Doorbell::wait() {
  if (!hosts_.is_leader) {
    if (!member_->receive()) {
      throw Error(ErrorCode::kEngine, "the first rank of this host has gone", "start the engine again");
    }
    return;
  }
  // A message that is expected costs one look each time: a probe would see only at the next what has arrived.
  MPI_Request ring = MPI_REQUEST_NULL;
  comm::check(MPI_Irecv(nullptr, 0, MPI_BYTE, 0, kRing, world_.get(), &ring), "MPI_Irecv");
  for (;;) {
    int rung = 0;
    comm::check(MPI_Test(&ring, &rung, MPI_STATUS_IGNORE), "MPI_Test");
    if (rung != 0) break;
    std::this_thread::sleep_for(kPause);
  }
  leader_->send(0);
}

}  // namespace footwall::service
