#include <mpi.h>

#include "engine/session/host_ranks.h"

namespace footwall::session {

int ranks_of_this_host(const comm::Communicator& world) {
  MPI_Comm host = MPI_COMM_NULL;
  comm::check(MPI_Comm_split_type(world.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host),
              "MPI_Comm_split_type");
  int ranks = 1;
  comm::check(MPI_Comm_size(host, &ranks), "MPI_Comm_size");
  comm::check(MPI_Comm_free(&host), "MPI_Comm_free");
  return ranks;
}

}  // namespace footwall::session
