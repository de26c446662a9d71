#include "engine/tasks/workload/values.h"

#include "storage/base/error.h"
#include "storage/base/splitmix64.h"

namespace footwall::tasks {

float hashed_value(std::uint64_t index, std::uint64_t seed) {
  const std::uint64_t x = mixed((index + 1) * kGolden + seed * 0xd1342543de82ef95U);
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
