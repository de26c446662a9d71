#include "engine/comm/environment.h"

#include <mpi.h>

#include "engine/comm/communicator.h"

namespace footwall::comm {

Environment::Environment(int& argc, char**& argv) {
  int provided = 0;
  check(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    throw Error(ErrorCode::kEngine, "this MPI library does not work together with threads",
                "use one built with MPI_THREAD_FUNNELED or better");
  }
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
}

Environment::~Environment() {
  MPI_Finalize();
}

}  // namespace footwall::comm
