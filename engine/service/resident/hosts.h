// Which ranks share a host.
#pragma once
#include <vector>

#include "engine/comm/communicator.h"

namespace footwall::service {

// Of each rank, the lowest rank of its host: the host's leader. Collective.
std::vector<int> host_of_ranks(const comm::Communicator& world);

// What a rank has to know of it. Tests give other hosts than there are.
struct Hosts {
  Hosts(const std::vector<int>& host_of, int rank);
  int leader = 0;                  // of this rank's host
  bool is_leader = false;          // this rank is it
  int members = 0;                 // other ranks of this rank's host
  std::vector<int> other_leaders;  // of the hosts that rank 0 is not on
};

}  // namespace footwall::service
