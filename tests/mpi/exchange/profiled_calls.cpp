#include "profiled_calls.h"

#include <mpi.h>

namespace {

footwall::ProfiledCalls calls;

std::int64_t bytes_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return std::int64_t{count} * size;
}

void count_send(int count, MPI_Datatype type, int to, MPI_Comm comm) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  if (to == rank || to == MPI_PROC_NULL) return;
  calls.bytes += bytes_of(count, type);
  ++calls.messages;
}

void count_to_all(int count, MPI_Datatype type, MPI_Comm comm) {
  int ranks = 0;
  PMPI_Comm_size(comm, &ranks);
  calls.bytes += bytes_of(count, type) * (ranks - 1);
  calls.messages += ranks - 1;
}

}  // namespace

namespace footwall {

ProfiledCalls profiled_calls() {
  return calls;
}

}  // namespace footwall

// The library's own entry points, which the linker finds here first. Every way to send that is not here would
// have to be added; the program uses no other than MPI_Isend and MPI_Alltoall today.
extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_send(count, type, to, comm);
  return PMPI_Send(data, count, type, to, tag, comm);
}

int MPI_Ssend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_send(count, type, to, comm);
  return PMPI_Ssend(data, count, type, to, tag, comm);
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  count_send(count, type, to, comm);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  count_send(count, type, to, comm);
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                 MPI_Datatype in_type, MPI_Comm comm) {
  count_to_all(out_count, out_type, comm);
  return PMPI_Alltoall(out, out_count, out_type, in, in_count, in_type, comm);
}

int MPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                  MPI_Datatype in_type, MPI_Comm comm) {
  count_to_all(out_count, out_type, comm);
  return PMPI_Allgather(out, out_count, out_type, in, in_count, in_type, comm);
}

}  // extern "C"
