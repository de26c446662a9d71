#include "engine/extract/gather.h"

#include <algorithm>
#include <cstring>

namespace footwall::extract {

void Gather::prepare(const comm::Communicator& world, std::span<const int> responsible,
                     std::vector<FaceStatistics>& faces) {
  faces.assign(world.rank() == 0 ? responsible.size() : 0, {});
  const auto ranks = static_cast<std::size_t>(world.size());
  counts_.assign(ranks, 0);
  for (const int rank : responsible) ++counts_.at(static_cast<std::size_t>(rank));
  mine_.clear();
  incoming_.clear();
  outgoing_.clear();
  if (world.rank() != 0) {
    mine_.reserve(static_cast<std::size_t>(counts_[static_cast<std::size_t>(world.rank())]));
    for (std::size_t n = 0; n < responsible.size(); ++n) {
      if (responsible[n] == world.rank()) mine_.push_back(n);
    }
    sent_.assign(mine_.size(), {});
    if (mine_.empty()) return;
    const auto bytes = std::as_bytes(std::span(sent_));
    outgoing_.push_back({0, bytes, bytes.size()});
    return;
  }
  received_.resize(ranks);
  for (std::size_t r = 1; r < ranks; ++r) {
    if (counts_[r] == 0) continue;
    received_[r].resize(static_cast<std::size_t>(counts_[r]));
    incoming_.push_back({static_cast<int>(r), std::as_writable_bytes(std::span(received_[r]))});
  }
}

void Gather::statistics(comm::Communicator& world, std::span<const int> responsible,
                        std::span<const Finished> finished, std::vector<FaceStatistics>& faces) {
  static_assert(std::is_trivially_copyable_v<FaceStatistics>);
  if (world.rank() != 0) {
    for (const Finished& each : finished) {
      const auto face = static_cast<std::size_t>(each.face);
      const auto at = std::lower_bound(mine_.begin(), mine_.end(), face);
      require(at != mine_.end() && *at == face, "a result of a face of this rank");
      sent_[static_cast<std::size_t>(at - mine_.begin())] = each.statistics;
    }
    world.exchange_known(outgoing_, incoming_);
    return;
  }
  world.exchange_known(outgoing_, incoming_);
  for (const Finished& each : finished) faces.at(static_cast<std::size_t>(each.face)) = each.statistics;
  std::fill(counts_.begin(), counts_.end(), 0);
  for (std::size_t n = 0; n < responsible.size(); ++n) {
    const auto rank = static_cast<std::size_t>(responsible[n]);
    if (rank != 0) faces[n] = received_[rank][static_cast<std::size_t>(counts_[rank]++)];
  }
}

std::vector<FaceBlobs> gather_blobs(comm::Communicator& world, std::vector<FinishedBlob> mine,
                                    std::span<const Computation* const> computations, std::size_t faces) {
  struct Head {
    std::int64_t face, computation, bytes;
  };
  const std::vector<comm::Bytes> parts = world.exchange(world.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world.size()));
    for (FinishedBlob& blob : mine) {
      const Head head{blob.face, static_cast<std::int64_t>(blob.computation),
                      static_cast<std::int64_t>(blob.bytes.size())};
      const auto raw = std::as_bytes(std::span(&head, 1));
      outgoing[0].insert(outgoing[0].end(), raw.begin(), raw.end());
      outgoing[0].insert(outgoing[0].end(), blob.bytes.begin(), blob.bytes.end());
      blob.bytes = {};
    }
    return outgoing;
  }));
  return world.collectively([&] {
    std::vector<FaceBlobs> all;
    if (world.rank() != 0) return all;
    std::vector<std::vector<std::span<const std::byte>>> of(computations.size(),
                                                            std::vector<std::span<const std::byte>>(faces));
    for (const comm::Bytes& part : parts) {
      for (std::size_t at = 0; at < part.size();) {
        Head head{};
        std::memcpy(&head, part.data() + at, sizeof head);
        at += sizeof head;
        of.at(static_cast<std::size_t>(head.computation)).at(static_cast<std::size_t>(head.face)) =
            std::span(part).subspan(at, static_cast<std::size_t>(head.bytes));
        at += static_cast<std::size_t>(head.bytes);
      }
    }
    for (std::size_t c = 0; c < computations.size(); ++c) {
      FaceBlobs& blobs = all.emplace_back();
      blobs.computation = computations[c]->name;
      blobs.offsets.push_back(0);
      for (const std::span<const std::byte> bytes : of[c]) {
        blobs.bytes.insert(blobs.bytes.end(), bytes.begin(), bytes.end());
        blobs.offsets.push_back(blobs.bytes.size());
      }
    }
    return all;
  });
}

}  // namespace footwall::extract
