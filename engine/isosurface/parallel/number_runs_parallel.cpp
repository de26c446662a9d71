#include <mpi.h>

#include <algorithm>

#include "engine/isosurface/parallel/number_runs.h"

namespace footwall::isosurface {
namespace {

constexpr std::uint64_t kSlotsAtOnce = std::uint64_t{1} << 23;

}  // namespace

std::uint64_t number_runs(const comm::Communicator& world, std::uint64_t slots, std::vector<Run>& runs) {
  std::vector<std::uint32_t> counts = world.collectively(
      [&] { return std::vector<std::uint32_t>(static_cast<std::size_t>(std::min(slots, kSlotsAtOnce))); });
  std::uint64_t number = 0;
  std::size_t counted = 0;
  std::size_t numbered = 0;
  for (std::uint64_t from = 0; from < slots; from += kSlotsAtOnce) {
    const std::uint64_t end = std::min(slots, from + kSlotsAtOnce);
    const auto here = static_cast<std::size_t>(end - from);
    std::fill_n(counts.begin(), here, 0U);
    for (; counted < runs.size() && runs[counted].slot < end; ++counted)
      counts[static_cast<std::size_t>(runs[counted].slot - from)] += runs[counted].count;
    comm::check(MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(here), MPI_UINT32_T, MPI_SUM,
                              world.get()),
                "MPI_Allreduce");
    // One pass over the slots; where runs of this rank begin, they are told.
    std::uint64_t slot = from;
    for (; numbered < counted;) {
      for (; slot < runs[numbered].slot; ++slot) number += counts[static_cast<std::size_t>(slot - from)];
      std::uint64_t first = number;
      for (; numbered < counted && runs[numbered].slot == slot; ++numbered) {
        runs[numbered].first = first;
        first += runs[numbered].count;
      }
    }
    for (; slot < end; ++slot) number += counts[static_cast<std::size_t>(slot - from)];
  }
  return number;
}

}  // namespace footwall::isosurface
