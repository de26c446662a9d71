// Idle ranks sleep in the kernel until rank 0 rings: MPI's own waiting would keep a core busy. Rank 0 wakes
// its host's ranks and the leaders of other hosts, and these theirs.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/service/resident/host_line.h"

namespace footwall::service {

class Doorbell {
 public:
  // folder: private, on each host. host_of: see hosts.h. Collective; throws on all ranks or on none.
  Doorbell(const comm::Communicator& world, const std::filesystem::path& folder,
           const std::vector<int>& host_of);

  // Rank 0: wakes the others, or their next wait() returns at once. Throws Error kEngine where one of those
  // that it rings itself has gone.
  void ring();
  // The others: returns once for each ring. Throws Error kEngine where the rank that rings this one has gone.
  void wait();

 private:
  std::optional<HostLineLeader> leader_;
  std::optional<HostLineMember> member_;
};

}  // namespace footwall::service
