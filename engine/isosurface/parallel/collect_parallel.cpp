#include <algorithm>

#include "engine/isosurface/parallel/collect.h"

namespace footwall::isosurface {
namespace {

// Stands before the elements of one run in a message.
struct Head {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

void append(comm::Bytes& bytes, const void* from, std::size_t size) {
  const auto* const first = static_cast<const std::byte*>(from);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

Bounds even_bounds(std::uint64_t all, int ranks) {
  Bounds bounds;
  const auto parts = static_cast<std::uint64_t>(ranks);
  for (std::uint64_t rank = 0; rank <= parts; ++rank)
    bounds.push_back(all / parts * rank + std::min(rank, all % parts));
  return bounds;
}

Bounds all_on_first(std::uint64_t all, int ranks) {
  Bounds bounds(static_cast<std::size_t>(ranks) + 1, all);
  bounds.front() = 0;
  return bounds;
}

comm::Bytes collect_bytes(comm::Communicator& world, std::span<const Run> runs,
                          std::span<const std::byte> elements, std::size_t element_bytes,
                          const Bounds& bounds) {
  std::vector<comm::Bytes> messages = world.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world.size()));
    std::size_t at = 0;  // in elements
    std::size_t rank = 0;
    for (const Run& run : runs) {
      std::uint64_t first = run.first;
      const std::uint64_t end = run.first + run.count;
      // Runs ascend, so that ranks do.
      while (first < end) {
        while (bounds[rank + 1] <= first) ++rank;
        const Head head{first, std::min(end, bounds[rank + 1]) - first};
        append(outgoing[rank], &head, sizeof head);
        const std::size_t size = static_cast<std::size_t>(head.count) * element_bytes;
        append(outgoing[rank], elements.data() + at * element_bytes, size);
        at += static_cast<std::size_t>(head.count);
        first += head.count;
      }
    }
    require(at * element_bytes == elements.size(), "the runs name all elements");
    return outgoing;
  });
  messages = world.exchange(std::move(messages));
  return world.collectively([&] {
    const auto self = static_cast<std::size_t>(world.rank());
    comm::Bytes mine(static_cast<std::size_t>(bounds[self + 1] - bounds[self]) * element_bytes);
    std::size_t filled = 0;
    for (const comm::Bytes& message : messages) {
      for (std::size_t at = 0; at < message.size();) {
        Head head;
        std::memcpy(&head, message.data() + at, sizeof head);
        at += sizeof head;
        const std::size_t size = static_cast<std::size_t>(head.count) * element_bytes;
        std::memcpy(mine.data() + (head.first - bounds[self]) * element_bytes, message.data() + at, size);
        at += size;
        filled += size;
      }
    }
    require(filled == mine.size(), "every number is in a run");
    return mine;
  });
}

}  // namespace footwall::isosurface
