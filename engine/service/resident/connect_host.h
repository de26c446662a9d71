// The ranks of each host on a line.
#pragma once
#include <optional>

#include "engine/service/resident/host_line.h"
#include "engine/service/resident/hosts.h"

namespace footwall::service {

// Makes one of the two ends on every rank. Collective; throws on all ranks or on none.
inline void connect_host(const comm::Communicator& world, const Hosts& hosts,
                         const std::filesystem::path& path, std::optional<HostLineLeader>& leader,
                         std::optional<HostLineMember>& member) {
  world.collectively([&] {
    if (hosts.is_leader) leader.emplace(path);
  });
  world.collectively([&] {
    if (!hosts.is_leader) member.emplace(path);
  });
  world.collectively([&] {
    if (hosts.is_leader) leader->accept(hosts.members);
  });
}

}  // namespace footwall::service
