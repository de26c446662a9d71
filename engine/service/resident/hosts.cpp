#include "engine/service/resident/hosts.h"

namespace footwall::service {

std::vector<int> host_of_ranks(const comm::Communicator& world) {
  MPI_Comm host = MPI_COMM_NULL;
  comm::check(MPI_Comm_split_type(world.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host),
              "MPI_Comm_split_type");
  const int rank = world.rank();
  int lowest = rank;
  comm::check(MPI_Allreduce(&rank, &lowest, 1, MPI_INT, MPI_MIN, host), "MPI_Allreduce");
  comm::check(MPI_Comm_free(&host), "MPI_Comm_free");
  std::vector<int> host_of(static_cast<std::size_t>(world.size()));
  comm::check(MPI_Allgather(&lowest, 1, MPI_INT, host_of.data(), 1, MPI_INT, world.get()), "MPI_Allgather");
  return host_of;
}

Hosts::Hosts(const std::vector<int>& host_of, int rank)
    : leader(host_of[static_cast<std::size_t>(rank)]), is_leader(leader == rank) {
  for (std::size_t each = 0; each < host_of.size(); ++each) {
    const auto number = static_cast<int>(each);
    if (number != rank && host_of[each] == leader) ++members;
    if (number != 0 && host_of[each] == number) other_leaders.push_back(number);
  }
}

}  // namespace footwall::service
