// Everyone sends something to some: sizes first, then the contents.
#include "engine/comm/communicator.h"

namespace footwall::comm {
namespace {

constexpr std::uint64_t kPiece = std::uint64_t{1} << 30;
constexpr int kTag = 1;

}  // namespace

std::vector<Bytes> Communicator::exchange(std::vector<Bytes> outgoing) {
  const auto ranks = static_cast<std::size_t>(size_);
  const auto self = static_cast<std::size_t>(rank_);

  // 1. Who sends how much to whom.
  std::vector<std::uint64_t> sizes_out(ranks, 0);
  std::vector<std::uint64_t> sizes_in(ranks, 0);
  collectively([&] {
    require(outgoing.size() == ranks, "bytes for every rank");
    for (std::size_t r = 0; r < ranks; ++r) sizes_out[r] = outgoing[r].size();
  });
  check(MPI_Alltoall(sizes_out.data(), 1, MPI_UINT64_T, sizes_in.data(), 1, MPI_UINT64_T, comm_),
        "MPI_Alltoall");
  traffic_.messages += size_ - 1;
  traffic_.bytes += static_cast<std::int64_t>(sizeof(std::uint64_t)) * (size_ - 1);

  // 2. Room for it, or nobody sends.
  std::vector<Bytes> incoming(ranks);
  std::vector<MPI_Request> requests;
  collectively([&] {
    std::size_t pieces = 0;
    for (std::size_t r = 0; r < ranks; ++r) {
      if (r == self) continue;
      incoming[r].resize(sizes_in[r]);
      pieces += (sizes_in[r] + kPiece - 1) / kPiece + (sizes_out[r] + kPiece - 1) / kPiece;
    }
    requests.reserve(pieces);
  });

  // 3. The contents, all at once, in pieces that MPI's int counts can name. Messages between two ranks keep
  // order.
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == self) continue;
    for (std::uint64_t at = 0; at < sizes_in[r]; at += kPiece) {
      const int count = static_cast<int>(std::min(kPiece, sizes_in[r] - at));
      check(MPI_Irecv(incoming[r].data() + at, count, MPI_BYTE, static_cast<int>(r), kTag, comm_,
                      &requests.emplace_back()),
            "MPI_Irecv");
    }
  }
  for (std::size_t n = 1; n < ranks; ++n) {
    const std::size_t r = (self + n) % ranks;  // not all to rank 0 first
    for (std::uint64_t at = 0; at < sizes_out[r]; at += kPiece) {
      const int count = static_cast<int>(std::min(kPiece, sizes_out[r] - at));
      check(MPI_Isend(outgoing[r].data() + at, count, MPI_BYTE, static_cast<int>(r), kTag, comm_,
                      &requests.emplace_back()),
            "MPI_Isend");
      ++traffic_.messages;
      traffic_.bytes += count;
    }
  }
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  incoming[self] = std::move(outgoing[self]);
  return incoming;
}

}  // namespace footwall::comm
