#include "engine/service/resident/doorbell.h"

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
  for (;;) {
    int there = 0;
    comm::check(MPI_Iprobe(0, kRing, world_.get(), &there, MPI_STATUS_IGNORE), "MPI_Iprobe");
    if (there != 0) break;
    std::this_thread::sleep_for(kPause);
  }
  comm::check(MPI_Recv(nullptr, 0, MPI_BYTE, 0, kRing, world_.get(), MPI_STATUS_IGNORE), "MPI_Recv");
  leader_->send(0);
}

}  // namespace footwall::service
