#include "engine/service/resident/connect_ranks.h"

#include <algorithm>
#include <cstring>

#include "engine/service/resident/far_line.h"

namespace footwall::service {
namespace {

template <typename T>
std::vector<T> from_first_rank(const comm::Communicator& world, const std::vector<T>& values) {
  const auto raw = std::as_bytes(std::span(values));
  const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
  std::vector<T> all(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  return all;
}

std::vector<HostAddress> chosen(std::span<const HostAddress> addresses, std::uint64_t ways) {
  std::vector<HostAddress> left;
  for (std::size_t n = 0; n < addresses.size(); ++n) {
    if ((ways >> n & 1U) != 0) left.push_back(addresses[n]);
  }
  return left;
}

}  // namespace

void connect_ranks(const comm::Communicator& world, const Hosts& hosts, const std::filesystem::path& path,
                   std::optional<HostLineLeader>& leader, std::optional<HostLineMember>& member) {
  // 1 The ranks of each host.
  world.collectively([&] {
    if (hosts.is_leader) leader.emplace(path);
  });
  world.collectively([&] {
    if (!hosts.is_leader) member.emplace(path);
  });
  world.collectively([&] {
    if (hosts.is_leader) leader->accept(hosts.members);
  });
  if (hosts.other_leaders.empty()) return;

  // 2 The addresses of rank 0's host by which the others can reach it.
  const bool leads_all = world.rank() == 0;
  const bool is_far = hosts.is_leader && !leads_all;
  const auto mine = world.collectively([&] { return own_addresses(); });
  const auto all = from_first_rank(world, mine);
  const std::uint64_t my_ways = is_far ? ways_to(all, mine) : 0;
  std::uint64_t ways = 0;
  comm::check(MPI_Allreduce(&my_ways, &ways, 1, MPI_UINT64_T, MPI_BOR, world.get()), "MPI_Allreduce");

  // 3 There it listens, for a moment, for those who know the secret.
  std::optional<FarListener> listener;
  std::vector<LineSecret> secret(1);
  world.collectively([&] {
    if (!leads_all) return;
    listener.emplace(chosen(all, ways));
    secret[0] = new_line_secret();
  });
  const auto doors = from_first_rank(world, leads_all ? listener->addresses() : std::vector<HostAddress>());
  secret = from_first_rank(world, secret);
  world.collectively([&] {
    if (leads_all) {
      for (Descriptor& line : listener->accept(static_cast<int>(hosts.other_leaders.size()), secret[0]))
        leader->take(std::move(line));
    } else if (is_far) {
      member.emplace(reach(chosen(doors, ways_to(doors, mine)), secret[0]));
    }
  });
}

}  // namespace footwall::service
