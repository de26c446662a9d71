#include "storage/volume/volume_reader_parallel.h"

#include <fmt/format.h>
#include <cstring>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "storage/volume/description.h"
#include "storage/volume/mpi_agreement.h"
#include "storage/volume/volume_file.h"

namespace footwall::volume {
namespace {

// What one transfer may hold in memory, unless a single chunk is larger.
constexpr std::int64_t kTransferBytes = std::int64_t{16} << 20;

// Neighbouring chunks along the inline axis: in that order their samples lie one chunk after another in
// memory too.
struct Run {
  survey::Index first{0, 0, 0};
  std::int64_t chunks = 0;
};

std::vector<Run> runs_of(const ChunkGrid& grid, const survey::Box& box) {
  const survey::Box touched = grid.touched_by(box);
  const std::int64_t chunk_bytes = grid.voxels() * static_cast<std::int64_t>(sizeof(float));
  const std::int64_t most = std::max<std::int64_t>(1, kTransferBytes / chunk_bytes);
  std::vector<Run> runs;
  for (std::int64_t j = touched.lo[1]; j < touched.hi[1]; ++j) {
    for (std::int64_t k = touched.lo[2]; k < touched.hi[2]; ++k) {
      for (std::int64_t i = touched.lo[0]; i < touched.hi[0]; i += most) {
        runs.push_back({{i, j, k}, std::min(most, touched.hi[0] - i)});
      }
    }
  }
  return runs;
}

class Info {
 public:
  explicit Info(const IoHints& hints) {
    check_mpi(MPI_Info_create(&info_), "MPI_Info_create");
    for (const auto& [name, value] : hints) {
      check_mpi(MPI_Info_set(info_, name.c_str(), value.c_str()), "MPI_Info_set");
    }
  }
  ~Info() { MPI_Info_free(&info_); }
  Info(const Info&) = delete;
  Info& operator=(const Info&) = delete;
  MPI_Info get() const { return info_; }

 private:
  MPI_Info info_ = MPI_INFO_NULL;
};

// All that rank 0 found out, for the others.
std::string packed(const VolumeFile& volume) {
  return nlohmann::json{
      {"description", describe(volume.info)}, {"chunk", volume.info.chunk}, {"bytes", volume.info.bytes}}
      .dump();
}

void unpack(const std::string& text, VolumeFile& volume) {
  const nlohmann::json j = nlohmann::json::parse(text);
  volume.info = info_from(j.at("description").get<Description>(), volume.path);
  volume.info.chunk = j.at("chunk").get<survey::Index>();
  volume.info.bytes = j.at("bytes").get<std::int64_t>();
  volume.grid = {volume.info.dims, volume.info.chunk};
}

}  // namespace

struct ParallelVolumeReader::State {
  OwnCommunicator comm;
  VolumeFile volume;
  IoReport report;
  std::vector<float> staging;

  explicit State(MPI_Comm parent) : comm(parent) {}

  void open(const std::filesystem::path& path, const IoHints& hints);
  void take(const survey::Box& box, std::span<float> out, IoReport::Mode mode);
  void transfer(const Run& run, hid_t properties);
  void note_transfer(const Run& run, hid_t properties);
  void deliver(const Run& run, const survey::Box& box, std::span<float> out) const;
};

ParallelVolumeReader::ParallelVolumeReader(MPI_Comm comm, const std::filesystem::path& path,
                                           const IoHints& hints)
    : state_(std::make_unique<State>(comm)) {
  state_->open(path, hints);
}
ParallelVolumeReader::~ParallelVolumeReader() = default;
ParallelVolumeReader::ParallelVolumeReader(ParallelVolumeReader&&) noexcept = default;
ParallelVolumeReader& ParallelVolumeReader::operator=(ParallelVolumeReader&&) noexcept = default;

const VolumeInfo& ParallelVolumeReader::info() const {
  return state_->volume.info;
}
const IoReport& ParallelVolumeReader::last_io() const {
  return state_->report;
}

void ParallelVolumeReader::State::open(const std::filesystem::path& path, const IoHints& hints) {
  quiet_hdf5();
  // One rank looks at the file in every detail; N ranks doing so would be a storm of small reads.
  std::string text;
  std::string hashes;
  agree(comm, outcome_of([&] {
          if (comm.rank() != 0) return;
          volume = open_volume(path);
          text = packed(volume);
          hashes.assign(reinterpret_cast<const char*>(volume.hashes.data()),
                        volume.hashes.size() * sizeof(std::uint64_t));
          volume.voxels.reset();
          volume.file.reset();
        }));
  broadcast(comm, text);
  broadcast(comm, hashes);
  Handle access;
  agree(comm, outcome_of([&] {
          volume.path = path;
          unpack(text, volume);
          volume.hashes.resize(hashes.size() / sizeof(std::uint64_t));
          std::memcpy(volume.hashes.data(), hashes.data(), hashes.size());
          const Info info(hints);
          access = Handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
          if (H5Pset_fapl_mpio(access.id(), comm.get(), info.get()) < 0 ||
              H5Pset_all_coll_metadata_ops(access.id(), true) < 0) {
            throw_hdf5(ErrorCode::kInternal, "cannot ask HDF5 for MPI-IO");
          }
        }));
  agree(comm, outcome_of([&] { volume.file = open_file_read_only(path, access.id()); }));
  agree(comm, outcome_of([&] {
          volume.voxels = Handle(H5Dopen2(volume.file.id(), kVoxels, H5P_DEFAULT), H5Dclose);
          if (!volume.voxels)
            throw_hdf5(ErrorCode::kCorrupt, fmt::format("{} of {}", kVoxels, path.string()));
        }));
}

void ParallelVolumeReader::State::transfer(const Run& run, hid_t properties) {
  const ChunkGrid& grid = volume.grid;
  const Handle file_space(H5Dget_space(volume.voxels.id()), H5Sclose);
  const auto side = [&](int axis, std::int64_t chunks) {
    return static_cast<hsize_t>(grid.chunk[axis] * chunks);
  };
  const hsize_t whole[3] = {side(0, std::max<std::int64_t>(1, run.chunks)), side(1, 1), side(2, 1)};
  const Handle memory_space(H5Screate_simple(3, whole, nullptr), H5Sclose);
  staging.resize(static_cast<std::size_t>(grid.voxels() * std::max<std::int64_t>(1, run.chunks)));
  if (run.chunks == 0) {
    H5Sselect_none(file_space.id());
    H5Sselect_none(memory_space.id());
  } else {
    hsize_t start[3];
    hsize_t count[3];
    const hsize_t origin[3] = {0, 0, 0};
    bool padded = false;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = side(axis, run.first[axis]);
      count[axis] = std::min(whole[axis], static_cast<hsize_t>(grid.dims[axis]) - start[axis]);
      padded = padded || count[axis] < whole[axis];
    }
    if (padded) std::fill(staging.begin(), staging.end(), 0.0F);  // HDF5 does not hand the padding out
    H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr);
    H5Sselect_hyperslab(memory_space.id(), H5S_SELECT_SET, origin, nullptr, count, nullptr);
  }
  if (H5Dread(volume.voxels.id(), H5T_NATIVE_FLOAT, memory_space.id(), file_space.id(), properties,
              staging.data()) < 0) {
    throw_altered(grid, grid.number_of(run.first), volume.path,
                  fmt::format("cannot be read ({})", last_hdf5_reason()));
  }
}

void ParallelVolumeReader::State::note_transfer(const Run& run, hid_t properties) {
  H5D_mpio_actual_io_mode_t mode = H5D_MPIO_NO_COLLECTIVE;
  H5D_mpio_actual_chunk_opt_mode_t chunking = H5D_MPIO_NO_CHUNK_OPTIMIZATION;
  std::uint32_t local_cause = 0;
  std::uint32_t global_cause = 0;
  if (H5Pget_mpio_actual_io_mode(properties, &mode) < 0 ||
      H5Pget_mpio_actual_chunk_opt_mode(properties, &chunking) < 0 ||
      H5Pget_mpio_no_collective_cause(properties, &local_cause, &global_cause) < 0) {
    throw_hdf5(ErrorCode::kInternal, "HDF5 does not say how it read");
  }
  const bool collective = mode == H5D_MPIO_CHUNK_COLLECTIVE || mode == H5D_MPIO_CONTIGUOUS_COLLECTIVE;
  const bool first = report.transfers == 0;
  if (first) report.actual = IoReport::Mode::kCollective;
  if (!collective) report.actual = IoReport::Mode::kIndependent;
  report.linked_chunks = (first || report.linked_chunks) && chunking == H5D_MPIO_LINK_CHUNK;
  report.no_collective_cause |= global_cause;
  ++report.transfers;
  report.chunks += run.chunks;
  report.bytes += run.chunks * volume.grid.voxels() * static_cast<std::int64_t>(sizeof(float));
}

void ParallelVolumeReader::State::deliver(const Run& run, const survey::Box& box,
                                          std::span<float> out) const {
  const ChunkGrid& grid = volume.grid;
  const float null_value = volume.info.null_value.value_or(std::numeric_limits<float>::quiet_NaN());
  for (std::int64_t n = 0; n < run.chunks; ++n) {
    const survey::Index place{run.first[0] + n, run.first[1], run.first[2]};
    const std::int64_t number = grid.number_of(place);
    const auto voxels = static_cast<std::size_t>(grid.voxels());
    const auto chunk = std::span(staging).subspan(static_cast<std::size_t>(n) * voxels, voxels);
    check_chunk(grid, number, chunk, volume.hashes[static_cast<std::size_t>(number)], volume.path);
    copy_clean(intersection(box, grid.box_of(place)), grid.full_box_of(place), chunk.data(), box, out.data(),
               null_value);
  }
}

void ParallelVolumeReader::State::take(const survey::Box& box, std::span<float> out, IoReport::Mode mode) {
  quiet_hdf5();
  const bool collective = mode == IoReport::Mode::kCollective;
  report = {};
  report.asked = mode;
  std::vector<Run> runs;
  Handle properties;
  const auto prepare = [&] {
    require_box(volume.grid, box, out.size());
    runs = runs_of(volume.grid, box);
    properties = Handle(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    if (H5Pset_dxpl_mpio(properties.id(), collective ? H5FD_MPIO_COLLECTIVE : H5FD_MPIO_INDEPENDENT) < 0 ||
        (collective && H5Pset_dxpl_mpio_chunk_opt(properties.id(), H5FD_MPIO_CHUNK_ONE_IO) < 0)) {
      throw_hdf5(ErrorCode::kInternal, "cannot set the transfer mode");
    }
    staging.reserve(static_cast<std::size_t>(volume.grid.voxels()) *
                    static_cast<std::size_t>(runs.empty() ? 1 : runs.front().chunks));
  };
  if (!collective) {
    prepare();
    for (const Run& run : runs) {
      transfer(run, properties.id());
      note_transfer(run, properties.id());
      deliver(run, box, out);
    }
    return;
  }

  agree(comm, outcome_of(prepare));
  const auto mine = static_cast<long long>(runs.size());
  long long rounds = 0;
  check_mpi(MPI_Allreduce(&mine, &rounds, 1, MPI_LONG_LONG, MPI_MAX, comm.get()), "MPI_Allreduce");
  std::optional<Error> failure;
  for (long long round = 0; round < rounds; ++round) {
    // A rank that is done, or has failed, keeps the others company with empty transfers.
    const Run run = round < mine && !failure ? runs[static_cast<std::size_t>(round)] : Run{};
    auto outcome = outcome_of([&] {
      transfer(run, properties.id());
      note_transfer(run, properties.id());
      deliver(run, box, out);
    });
    if (!failure) failure = std::move(outcome);
  }
  agree(comm, failure);
}

void ParallelVolumeReader::read_collective(const survey::Box& box, std::span<float> out) {
  state_->take(box, out, IoReport::Mode::kCollective);
}

void ParallelVolumeReader::read_independent(const survey::Box& box, std::span<float> out) {
  state_->take(box, out, IoReport::Mode::kIndependent);
}

}  // namespace footwall::volume
