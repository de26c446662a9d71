#include "engine/service/resident/load_volume.h"

#include <algorithm>

#include "storage/volume/volume_reader_parallel.h"

namespace footwall::service {
namespace {

// What is read between two looks at cancel.
constexpr std::int64_t kPieceBytes = std::int64_t{8} << 20;

}  // namespace

struct VolumeLoader::State {
  State(const comm::Communicator& its_world, const std::filesystem::path& path)
      : world(its_world),
        // The reader throws on all ranks or on none, so that it may stand inside collectively().
        reader(world.collectively([&] { return volume::ParallelVolumeReader(world.get(), path); })) {}

  // A slab in pieces along the crosslines, cut between chunks.
  void read(const survey::Box& slab, std::span<float> values, const JobContext& job) {
    const std::int64_t chunk = reader.info().chunk[1];
    const std::int64_t line_bytes = slab.size(0) * slab.size(2) * std::int64_t{sizeof(float)};
    const std::int64_t lines =
        std::max<std::int64_t>(1, kPieceBytes / std::max<std::int64_t>(1, line_bytes * chunk)) * chunk;
    if (slab.size(1) <= lines) {
      job.check();
      reader.read_independent(slab, values);
      return;
    }
    const std::int64_t samples = slab.size(2);
    for (std::int64_t from = slab.lo[1]; from < slab.hi[1];) {
      job.check();
      const std::int64_t to = std::min(slab.hi[1], (from / lines + 1) * lines);
      const survey::Box part{{slab.lo[0], from, slab.lo[2]}, {slab.hi[0], to, slab.hi[2]}};
      piece.resize(static_cast<std::size_t>(part.count()));
      reader.read_independent(part, piece);
      for (std::int64_t i = 0; i < slab.size(0); ++i) {
        std::copy_n(piece.data() + i * part.size(1) * samples, part.size(1) * samples,
                    values.data() + (i * slab.size(1) + from - slab.lo[1]) * samples);
      }
      from = to;
    }
  }

  const comm::Communicator& world;
  volume::ParallelVolumeReader reader;
  std::vector<float> piece;
};

VolumeLoader::VolumeLoader(const comm::Communicator& world, const std::filesystem::path& path)
    : state_(std::make_unique<State>(world, path)) {}
VolumeLoader::~VolumeLoader() = default;

const volume::VolumeInfo& VolumeLoader::info() const {
  return state_->reader.info();
}

std::vector<std::int64_t> VolumeLoader::bytes_that_stay() const {
  const comm::RankGrid grid(info().dims, state_->world.size());
  std::vector<std::int64_t> bytes;
  for (int rank = 0; rank < grid.ranks(); ++rank) {
    const survey::Box box = grid.box(rank);
    bytes.push_back(
        box.empty() ? 0 : (box.size(0) + 2) * (box.size(1) + 2) * box.size(2) * std::int64_t{sizeof(float)});
  }
  return bytes;
}

std::vector<std::int64_t> VolumeLoader::bytes_that_pass() const {
  const comm::RankGrid grid(info().dims, state_->world.size());
  std::vector<std::int64_t> bytes;
  for (int rank = 0; rank < grid.ranks(); ++rank) {
    const survey::Box box = grid.box(rank);
    const std::int64_t slab = std::min(extract::kSlabInlines, box.size(0) + 2) * (box.size(1) + 2) *
                              box.size(2) * std::int64_t{sizeof(float)};
    bytes.push_back(box.empty() ? 0 : slab + std::min(slab, 2 * kPieceBytes));
  }
  return bytes;
}

std::unique_ptr<extract::LoadedSurvey> VolumeLoader::load(const JobContext& job) {
  // Inside collectively(), as LoadedSurvey promises: each rank may read and fail by itself.
  const auto read = [&](const survey::Box& slab, std::span<float> values) {
    if (!slab.empty()) state_->read(slab, values, job);
  };
  return std::make_unique<extract::LoadedSurvey>(state_->world, info().dims, read, job);
}

}  // namespace footwall::service
