// All ranks on a line of two steps: from rank 0 to its host's ranks and the leaders of the other hosts, from
// these to theirs.
#pragma once
#include <filesystem>
#include <optional>

#include "engine/service/resident/host_line.h"
#include "engine/service/resident/hosts.h"

namespace footwall::service {

// Makes the ends that a rank needs: `leader` where it passes words on, `member` where it gets them, all but
// on rank 0. path: of the host's socket. Collective; throws on all ranks or on none.
void connect_ranks(const comm::Communicator& world, const Hosts& hosts, const std::filesystem::path& path,
                   std::optional<HostLineLeader>& leader, std::optional<HostLineMember>& member);

}  // namespace footwall::service
