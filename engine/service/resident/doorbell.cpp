#include "engine/service/resident/doorbell.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "engine/service/resident/connect_ranks.h"

namespace footwall::service {
namespace {

constexpr std::chrono::seconds kTimeToSayWhy{1};

}  // namespace

Doorbell::Doorbell(const comm::Communicator& world, const std::filesystem::path& folder,
                   const std::vector<int>& host_of) {
  const Hosts hosts(host_of, world.rank());
  connect_ranks(world, hosts, folder / fmt::format("doorbell-{}", hosts.leader), leader_, member_);
}

void Doorbell::ring() {
  leader_->send(0);
}

void Doorbell::wait() {
  if (!member_->receive()) {
    // It may be about to say why, and to end all: those words should not be cut off by this rank's end.
    std::this_thread::sleep_for(kTimeToSayWhy);
    throw Error(ErrorCode::kEngine, "the rank that wakes this one has gone", "start the engine again");
  }
  if (leader_) leader_->send(0);
}

}  // namespace footwall::service
