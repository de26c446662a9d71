// Idle ranks sleep until rank 0 rings: MPI's own waiting would keep a core busy. On rank 0's host they block
// in the kernel; the leader of every other host looks for a message every 2 ms, and wakes its host's ranks.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/service/resident/host_line.h"
#include "engine/service/resident/hosts.h"

namespace footwall::service {

class Doorbell {
 public:
  // folder: private, on each host. host_of: see hosts.h. Collective; throws on all ranks or on none.
  Doorbell(const comm::Communicator& world, const std::filesystem::path& folder,
           const std::vector<int>& host_of);

  // Rank 0: wakes the others, or their next wait() returns at once. Throws Error kEngine where a rank of this
  // host has gone.
  void ring();
  // The others: returns once for each ring. Throws Error kEngine where the host's leader has gone.
  void wait();

 private:
  comm::Communicator world_;
  Hosts hosts_;
  std::optional<HostLineLeader> leader_;
  std::optional<HostLineMember> member_;
};

}  // namespace footwall::service
