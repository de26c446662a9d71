#include "engine/comm/transfer.h"

#include <algorithm>

namespace footwall::comm {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;

}  // namespace

std::vector<std::uint64_t> exchange_sizes(Communicator& world, const std::vector<std::uint64_t>& outgoing) {
  std::vector<std::uint64_t> incoming(outgoing.size(), 0);
  require(outgoing.size() == static_cast<std::size_t>(world.size()), "a size for every rank");
  check(MPI_Alltoall(outgoing.data(), 1, MPI_UINT64_T, incoming.data(), 1, MPI_UINT64_T, world.get()),
        "MPI_Alltoall");
  world.count(static_cast<std::int64_t>(sizeof(std::uint64_t)) * (world.size() - 1), world.size() - 1);
  return incoming;
}

Transfer::Transfer(Communicator& world, int tag)
    : world_(world), tag_(tag), pieces_left_(static_cast<std::size_t>(world.size()), 0) {}

Transfer::~Transfer() {
  // Where it ends early, the error that did it is told, not that of a transfer nobody waits for.
  if (open_ > 0) MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

void Transfer::receive(int from, std::span<std::byte> into) {
  for (std::size_t at = 0; at < into.size(); at += kPiece) {
    const int count = static_cast<int>(std::min(kPiece, into.size() - at));
    MPI_Request request = MPI_REQUEST_NULL;
    requests_.reserve(requests_.size() + 1);
    pieces_.push_back({from, count});
    check(MPI_Irecv(into.data() + at, count, MPI_BYTE, from, tag_, world_.get(), &request), "MPI_Irecv");
    requests_.push_back(request);
    ++pieces_left_[static_cast<std::size_t>(from)];
    ++open_;
  }
}

void Transfer::send(int to, std::span<const std::byte> bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const int count = static_cast<int>(std::min(kPiece, bytes.size() - at));
    MPI_Request request = MPI_REQUEST_NULL;
    requests_.reserve(requests_.size() + 1);
    pieces_.push_back({-1, count});
    check(MPI_Isend(bytes.data() + at, count, MPI_BYTE, to, tag_, world_.get(), &request), "MPI_Isend");
    requests_.push_back(request);
    ++open_;
    world_.count(count, 1);
  }
}

void Transfer::ended(std::size_t n, const MPI_Status& status) {
  --open_;
  const Piece& piece = pieces_[n];
  if (piece.from < 0) return;
  int bytes = 0;
  check(MPI_Get_count(&status, MPI_BYTE, &bytes), "MPI_Get_count");
  if (bytes != piece.bytes) {
    throw Error(ErrorCode::kEngine, "rank " + std::to_string(piece.from) + " sent " + std::to_string(bytes) +
                                        " bytes where " + std::to_string(piece.bytes) + " were expected");
  }
  if (--pieces_left_[static_cast<std::size_t>(piece.from)] == 0) received_.push_back(piece.from);
}

void Transfer::take(bool wait) {
  const auto count = static_cast<int>(requests_.size());
  ended_.resize(requests_.size());
  statuses_.resize(requests_.size());
  int done = 0;
  if (wait) {
    check(MPI_Waitsome(count, requests_.data(), &done, ended_.data(), statuses_.data()), "MPI_Waitsome");
  } else {
    check(MPI_Testsome(count, requests_.data(), &done, ended_.data(), statuses_.data()), "MPI_Testsome");
  }
  for (int n = 0; n < (done == MPI_UNDEFINED ? 0 : done); ++n) {
    ended(static_cast<std::size_t>(ended_[static_cast<std::size_t>(n)]),
          statuses_[static_cast<std::size_t>(n)]);
  }
}

bool Transfer::progress() {
  if (open_ > 0) take(false);
  return open_ == 0;
}

int Transfer::next_received() {
  while (received_.empty()) {
    if (std::all_of(pieces_left_.begin(), pieces_left_.end(), [](int left) { return left == 0; })) return -1;
    take(true);
  }
  const int from = received_.back();
  received_.pop_back();
  return from;
}

void Transfer::wait() {
  while (open_ > 0) take(true);
}

}  // namespace footwall::comm
