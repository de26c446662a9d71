#include "engine/tasks/workload/values.h"

#include "storage/base/error.h"

namespace footwall::tasks {

// Based on: Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014 (the finalizer of
// SplitMix64 over a counter).
float hashed_value(std::uint64_t index, std::uint64_t seed) {
  std::uint64_t x = (index + 1) * 0x9e3779b97f4a7c15U + seed * 0xd1342543de82ef95U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  x ^= x >> 31;
  return static_cast<float>(static_cast<std::int32_t>(x >> 40)) * 0x1p-23F - 1.0F;
}

void fill_hashed(const survey::Index& dims, std::uint64_t seed, const survey::Box& box,
                 std::span<float> values) {
  require(static_cast<std::int64_t>(values.size()) == box.count(), "room for the values of the box");
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      const auto trace = static_cast<std::uint64_t>((i * dims[1] + j) * dims[2]);
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
        values[n++] = hashed_value(trace + static_cast<std::uint64_t>(k), seed);
    }
  }
}

}  // namespace footwall::tasks
