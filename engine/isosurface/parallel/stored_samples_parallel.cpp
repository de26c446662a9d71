#include <mpi.h>

#include <algorithm>

#include "engine/isosurface/parallel/stored_samples.h"
#include "storage/volume/volume_reader.h"

namespace footwall::isosurface {
namespace {

// Elements of rank 0 on all ranks, in pieces whose sizes an int can name.
template <class T>
void hand_out(const comm::Communicator& world, std::vector<T>& values) {
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  const std::size_t bytes = values.size() * sizeof(T);
  auto* const at = reinterpret_cast<std::byte*>(values.data());
  for (std::size_t from = 0; from < bytes; from += kPiece) {
    comm::check(
        MPI_Bcast(at + from, static_cast<int>(std::min(kPiece, bytes - from)), MPI_BYTE, 0, world.get()),
        "MPI_Bcast");
  }
}

}  // namespace

StoredSamples::StoredSamples(comm::Communicator& world, const std::filesystem::path& path)
    // The reader throws on all ranks or on none, so that it may stand inside collectively().
    : reader_(world.collectively([&] { return volume::ParallelVolumeReader(world.get(), path); })) {
  world.collectively([&] {
    if (world.rank() == 0) {
      level_ = volume::VolumeReader(path).min_max(0);
      return;
    }
    level_.dims = volume::min_max_dims(info().dims, 0);
    const auto entries = static_cast<std::size_t>(level_.dims[0] * level_.dims[1] * level_.dims[2]);
    level_.min.resize(entries);
    level_.max.resize(entries);
    level_.has_null.resize(entries);
  });
  hand_out(world, level_.min);
  hand_out(world, level_.max);
  hand_out(world, level_.has_null);
  bricks_ = {level_.dims, level_.min, level_.max, level_.has_null};
}

std::int64_t StoredSamples::memory_bytes() const {
  return static_cast<std::int64_t>(values_.room_bytes() + level_.min.size() * sizeof(float) +
                                   level_.max.size() * sizeof(float) + level_.has_null.size());
}

Field StoredSamples::read(const survey::Box& samples) {
  values_.resize_uninitialised(static_cast<std::size_t>(samples.count()));
  reader_.read_independent(samples, values_.all());
  bytes_read_ += reader_.last_io().bytes;
  return {values_.all(), {samples.size(0), samples.size(1), samples.size(2)}, samples.lo, info().dims};
}

}  // namespace footwall::isosurface
