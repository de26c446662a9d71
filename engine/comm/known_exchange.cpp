// Messages between partners who know of each other: one round.
#include "engine/comm/communicator.h"

namespace footwall::comm {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;
constexpr int kTag = 1000;  // beside those of Transfer

// Both sides cut a message into the pieces of its longest form, so that neither needs to know its size.
std::size_t pieces_of(std::size_t most) {
  return std::max<std::size_t>(1, (most + kPiece - 1) / kPiece);
}

int part_of(std::size_t size, std::size_t piece) {
  const std::size_t before = std::min(size, piece * kPiece);
  return static_cast<int>(std::min(kPiece, size - before));
}

}  // namespace

void Communicator::exchange_known(std::span<const KnownOutgoing> outgoing,
                                  std::span<KnownIncoming> incoming) {
  begin_known(outgoing, incoming);
  end_known(incoming);
}

void Communicator::begin_known(std::span<const KnownOutgoing> outgoing,
                               std::span<const KnownIncoming> incoming) {
  require(requests_.empty(), "one exchange of known messages at a time");
  for (const KnownIncoming& from : incoming) {
    for (std::size_t piece = 0; piece < pieces_of(from.room.size()); ++piece) {
      check(MPI_Irecv(from.room.data() + piece * kPiece, part_of(from.room.size(), piece), MPI_BYTE,
                      from.rank, kTag, comm_, &requests_.emplace_back()),
            "MPI_Irecv");
    }
  }
  for (const KnownOutgoing& to : outgoing) {
    require(to.rank != rank_ && to.bytes.size() <= to.most, "a message to another rank that fits");
    for (std::size_t piece = 0; piece < pieces_of(to.most); ++piece) {
      const int count = part_of(to.bytes.size(), piece);
      check(MPI_Isend(to.bytes.data() + std::min(to.bytes.size(), piece * kPiece), count, MPI_BYTE, to.rank,
                      kTag, comm_, &requests_.emplace_back()),
            "MPI_Isend");
      ++traffic_.messages;
      traffic_.bytes += count;
    }
  }
}

void Communicator::progress_known() {
  if (requests_.empty()) return;
  // Completes nothing, so that end_known() finds every request and its status.
  int done = 0;
  check(MPI_Request_get_status(requests_.front(), &done, MPI_STATUS_IGNORE), "MPI_Request_get_status");
}

void Communicator::end_known(std::span<KnownIncoming> incoming) {
  statuses_.resize(requests_.size());
  check(MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), statuses_.data()), "MPI_Waitall");
  std::size_t next = 0;
  for (KnownIncoming& from : incoming) {
    from.received = 0;
    for (std::size_t piece = 0; piece < pieces_of(from.room.size()); ++piece, ++next) {
      int count = 0;
      check(MPI_Get_count(&statuses_[next], MPI_BYTE, &count), "MPI_Get_count");
      from.received += static_cast<std::size_t>(count);
    }
  }
  require(next <= requests_.size(), "the messages that were begun");
  requests_.clear();
}

}  // namespace footwall::comm
