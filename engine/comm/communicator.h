// A thin owner of an MPI communicator. Every return code is checked (MPI_ERRORS_RETURN) and thrown as Error
// kEngine; what is sent is counted, so that reports of bytes and messages are measured and not modelled.
#pragma once
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "storage/base/error.h"

namespace footwall::comm {

// Throws Error kEngine for any code but MPI_SUCCESS: "MPI_Isend failed: <MPI's text>".
void check(int code, const char* call);

// What this rank sent to other ranks.
struct Traffic {
  std::int64_t bytes = 0;
  std::int64_t messages = 0;
};

using Bytes = std::vector<std::byte>;

// One message of exchange_known(). `most` is known alike to sender and receiver: the receiver's room.
struct KnownOutgoing {
  int rank = 0;
  std::span<const std::byte> bytes;
  std::size_t most = 0;
};
struct KnownIncoming {
  int rank = 0;
  std::span<std::byte> room;
  std::size_t received = 0;  // set by exchange_known()
};

// An Error that all ranks throw together: each may leave in order. Any other exception is of one rank alone,
// whose program must call MPI_Abort so that the others do not wait for it.
class AgreedError : public Error {
 public:
  explicit AgreedError(const Error& error) : Error(error) {}
};

class Communicator {
 public:
  // A duplicate of `parent`, so that nobody else's messages can be mistaken for ours. Collective.
  explicit Communicator(MPI_Comm parent);
  // The ranks of `parent` as MPI's Cartesian grid, without reordering: rank r owns grid.box(r). Collective;
  // throws kInternal where the sizes differ.
  Communicator(const Communicator& parent, const RankGrid& grid);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  MPI_Comm get() const { return comm_; }

  // Runs f, which must hold no communication, on every rank and agrees on the outcome: where any rank threw,
  // every rank throws the Error of the lowest such rank (other exceptions become kMemory or kInternal), else
  // each returns its own value. Collective.
  template <typename F>
  auto collectively(F&& f) const;

  // Sends outgoing[r] to each rank r and returns what each rank sent here (own bytes are moved over). Sizes
  // go first, then only what is not empty, in non-blocking messages of at most 1 GiB. Collective; agrees on
  // memory before anything large is sent. Counted: 8 bytes and a message for every size, and the contents.
  std::vector<Bytes> exchange(std::vector<Bytes> outgoing);
  // The same where both sides know beforehand who sends to whom, and at most how much: one round, no sizes,
  // and no message but those named; an empty one is sent, too. Partners other than this rank, each once. No
  // agreement: what can fail has to be done before, and a rank whose work failed still sends something.
  void exchange_known(std::span<const KnownOutgoing> outgoing, std::span<KnownIncoming> incoming);
  // Its two halves, for a rank that has something else to do meanwhile; one at a time. The memory of all
  // messages must stay as it is between them.
  void begin_known(std::span<const KnownOutgoing> outgoing, std::span<const KnownIncoming> incoming);
  void progress_known();  // lets MPI work; only the thread that called MPI_Init may
  void end_known(std::span<KnownIncoming> incoming);
  // What was sent so far by these, exchange_sizes() and Transfer (transfer.h).
  const Traffic& traffic() const { return traffic_; }
  // Adds what was sent otherwise.
  void count(std::int64_t bytes, std::int64_t messages) {
    traffic_.bytes += bytes;
    traffic_.messages += messages;
  }

  // `bytes` of rank `root` everywhere. Collective.
  Bytes broadcast(Bytes bytes, int root) const;
  double maximum(double value) const;              // collective
  std::int64_t maximum(std::int64_t value) const;  // collective
  std::int64_t sum(std::int64_t value) const;      // collective; no check for overflow
  // Throws the lowest rank's error on all ranks as AgreedError, or returns on all. Collective.
  void agree(const std::optional<Error>& mine) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
  Traffic traffic_;
  std::vector<MPI_Request> requests_;  // of exchange_known(), to be used again
  std::vector<MPI_Status> statuses_;
};

// The exception now being handled as an Error; call inside a catch block only.
Error current_error();

template <typename F>
auto Communicator::collectively(F&& f) const {
  using Value = std::invoke_result_t<F&>;
  std::optional<Error> error;
  if constexpr (std::is_void_v<Value>) {
    try {
      f();
    } catch (...) {
      error = current_error();
    }
    agree(error);
  } else {
    std::optional<Value> value;
    try {
      value.emplace(f());
    } catch (...) {
      error = current_error();
    }
    agree(error);
    return Value(std::move(*value));
  }
}

}  // namespace footwall::comm
