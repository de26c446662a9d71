// Elements that are spread over ranks in runs, brought together in the order of their numbers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/page_vector.h"
#include "engine/isosurface/parallel/number_runs.h"

namespace footwall::isosurface {

// Rank r gets the numbers bounds[r] up to bounds[r + 1].
using Bounds = std::vector<std::uint64_t>;
Bounds even_bounds(std::uint64_t all, int ranks);
Bounds all_on_first(std::uint64_t all, int ranks);

// elements: those of this rank's runs, one run after the other, `element_bytes` each. Returns the elements of
// this rank's bounds; every number must be in a run of some rank. Collective; throws kMemory on all ranks.
// Memory: what goes out and what comes in, twice.
comm::Bytes collect_bytes(comm::Communicator& world, std::span<const Run> runs,
                          std::span<const std::byte> elements, std::size_t element_bytes,
                          const Bounds& bounds);

template <class T>
PageVector<T> collect(comm::Communicator& world, std::span<const Run> runs, std::span<const T> elements,
                      const Bounds& bounds) {
  static_assert(std::is_trivially_copyable_v<T>);
  const comm::Bytes bytes = collect_bytes(world, runs, std::as_bytes(elements), sizeof(T), bounds);
  return world.collectively([&] {
    PageVector<T> values;
    values.resize_uninitialised(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  });
}

}  // namespace footwall::isosurface
