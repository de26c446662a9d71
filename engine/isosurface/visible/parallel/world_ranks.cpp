#include "engine/isosurface/visible/parallel/world_ranks.h"

#include <mpi.h>

#include <utility>

namespace footwall::isosurface {

void WorldRanks::together(const std::function<void()>& work) {
  world_.collectively([&] {
    job_.check();
    work();
  });
}

void WorldRanks::reduce(void* values, std::size_t count, MPI_Datatype type, MPI_Op operation,
                        std::size_t bytes) {
  if (world_.size() == 1 || count == 0) return;
  comm::check(MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), type, operation, world_.get()),
              "MPI_Allreduce");
  // What each rank has to send at least: its share of the values, and the sums of its share.
  world_.count(static_cast<std::int64_t>(2 * bytes * static_cast<std::size_t>(world_.size() - 1) /
                                         static_cast<std::size_t>(world_.size())),
               2);
}

void WorldRanks::least(std::span<render::CoarseDepth> values) {
  reduce(values.data(), values.size(), MPI_UINT16_T, MPI_MIN, values.size_bytes());
}
void WorldRanks::most(std::span<std::int64_t> values) {
  reduce(values.data(), values.size(), MPI_INT64_T, MPI_MAX, values.size_bytes());
}
void WorldRanks::sum(std::span<std::int64_t> values) {
  reduce(values.data(), values.size(), MPI_INT64_T, MPI_SUM, values.size_bytes());
}
void WorldRanks::any(std::span<std::uint64_t> bits) {
  reduce(bits.data(), bits.size(), MPI_UINT64_T, MPI_BOR, bits.size_bytes());
}

std::vector<std::int64_t> WorldRanks::all(std::span<const std::int64_t> values) {
  std::vector<std::int64_t> gathered(values.size() * static_cast<std::size_t>(world_.size()));
  const int count = static_cast<int>(values.size());
  comm::check(
      MPI_Allgather(values.data(), count, MPI_INT64_T, gathered.data(), count, MPI_INT64_T, world_.get()),
      "MPI_Allgather");
  world_.count(static_cast<std::int64_t>(values.size_bytes()) * (world_.size() - 1), world_.size() - 1);
  return gathered;
}

std::vector<std::vector<std::byte>> WorldRanks::exchange(std::vector<std::vector<std::byte>> bytes) {
  return world_.exchange(std::move(bytes));
}

}  // namespace footwall::isosurface
