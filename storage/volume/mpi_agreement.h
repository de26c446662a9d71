// What the parallel reader and writer need of MPI beside MPI-IO: checked return codes, and one outcome for
// all ranks.
#pragma once
#include <mpi.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "storage/base/error.h"

namespace footwall::volume {

// Throws kEngine with MPI's own text unless `code` is MPI_SUCCESS.
void check_mpi(int code, const char* call);

// A communicator of our own that reports errors as return codes.
class OwnCommunicator {
 public:
  explicit OwnCommunicator(MPI_Comm parent);
  ~OwnCommunicator();
  OwnCommunicator(const OwnCommunicator&) = delete;
  OwnCommunicator& operator=(const OwnCommunicator&) = delete;
  MPI_Comm get() const { return comm_; }
  int rank() const;
  int size() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

// The error `f` throws, or nothing. f holds no communication that others could wait in.
std::optional<Error> outcome_of(const std::function<void()>& f);

// Collective: if any rank brings an error, all throw that of the lowest such rank.
void agree(const OwnCommunicator& comm, const std::optional<Error>& mine);

// Collective: rank 0's text on all ranks.
void broadcast(const OwnCommunicator& comm, std::string& text);

// Bytes to or from one other rank, who knows how many there are. Blocks.
void send(const OwnCommunicator& comm, std::span<const std::byte> bytes, int to);
void receive(const OwnCommunicator& comm, std::span<std::byte> bytes, int from);

}  // namespace footwall::volume
