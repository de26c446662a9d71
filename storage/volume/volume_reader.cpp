#include "storage/volume/volume_reader.h"

#include <fmt/format.h>

#include <limits>

#include "storage/volume/volume_file.h"

namespace footwall::volume {

struct VolumeReader::State {
  VolumeFile volume;
  std::vector<float> chunk;  // the one being looked at

  // The chunk's samples, padding included, as they are in the file; throws kCorrupt.
  const float* checked_chunk(const survey::Index& place) {
    const ChunkGrid& grid = volume.grid;
    const std::int64_t number = grid.number_of(place);
    chunk.resize(static_cast<std::size_t>(grid.voxels()));
    const hsize_t offset[3] = {static_cast<hsize_t>(place[0] * grid.chunk[0]),
                               static_cast<hsize_t>(place[1] * grid.chunk[1]),
                               static_cast<hsize_t>(place[2] * grid.chunk[2])};
    std::uint32_t filters = 0;
    {
      const Hdf5Use hdf5;  // not for the hash
      // Raw and whole: neither HDF5's chunk cache nor its selections would make the hash any cheaper.
      if (H5Dread_chunk(volume.voxels.id(), H5P_DEFAULT, offset, &filters, chunk.data()) < 0) {
        throw_altered(grid, number, volume.path, fmt::format("cannot be read ({})", last_hdf5_reason()));
      }
    }
    check_chunk(grid, number, chunk, volume.hashes[static_cast<std::size_t>(number)], volume.path);
    return chunk.data();
  }
};

VolumeReader::VolumeReader(const std::filesystem::path& path)
    : state_(std::make_unique<State>(State{open_volume(path), {}})) {}
VolumeReader::~VolumeReader() = default;
VolumeReader::VolumeReader(VolumeReader&&) noexcept = default;
VolumeReader& VolumeReader::operator=(VolumeReader&&) noexcept = default;

const VolumeInfo& VolumeReader::info() const {
  return state_->volume.info;
}
const std::filesystem::path& VolumeReader::path() const {
  return state_->volume.path;
}
std::span<const std::uint64_t> VolumeReader::chunk_hashes() const {
  return state_->volume.hashes;
}

std::vector<std::uint8_t> VolumeReader::live_mask() const {
  const Hdf5Use hdf5;
  const VolumeFile& volume = state_->volume;
  const Extent extent{static_cast<hsize_t>(volume.grid.dims[0]), static_cast<hsize_t>(volume.grid.dims[1])};
  const Handle dataset = open_plain(volume.file.id(), kLive, H5T_STD_U8LE, extent, volume.path);
  std::vector<std::uint8_t> live(extent[0] * extent[1]);
  read_slab(dataset.id(), H5T_NATIVE_UINT8, {0, 0}, extent, live.data());
  check_hash(dataset.id(), std::as_bytes(std::span(live)), kLive, volume.path);
  return live;
}

void VolumeReader::read(const survey::Box& box, std::span<float> out) const {
  const ChunkGrid& grid = state_->volume.grid;
  require_box(grid, box, out.size());
  const float null_value = state_->volume.info.null_value.value_or(std::numeric_limits<float>::quiet_NaN());
  const survey::Box touched = grid.touched_by(box);
  for (std::int64_t i = touched.lo[0]; i < touched.hi[0]; ++i) {
    for (std::int64_t j = touched.lo[1]; j < touched.hi[1]; ++j) {
      for (std::int64_t k = touched.lo[2]; k < touched.hi[2]; ++k) {
        const float* chunk = state_->checked_chunk({i, j, k});
        copy_clean(intersection(box, grid.box_of({i, j, k})), grid.full_box_of({i, j, k}), chunk, box,
                   out.data(), null_value);
      }
    }
  }
}

void VolumeReader::verify(const JobContext& job) const {
  const ChunkGrid& grid = state_->volume.grid;
  const std::int64_t chunks = grid.count();
  std::int64_t altered = 0;
  std::string first;
  for (std::int64_t number = 0; number < chunks; ++number) {
    job.report(static_cast<double>(number) / static_cast<double>(chunks), "verify",
               fmt::format("{} of {} chunks", number, chunks));
    try {
      state_->checked_chunk(grid.place_of(number));
    } catch (const Error& error) {
      if (altered++ == 0) first = error.message();
    }
  }
  if (altered > 0) {
    throw Error(ErrorCode::kCorrupt, fmt::format("{}; {} of {} chunks are damaged", first, altered, chunks),
                "restore it from a copy, or import it again");
  }
  live_mask();
  for (int level = 0; level < min_max_levels(grid.dims); ++level) min_max(level);
  job.report(1, "verify", fmt::format("{} chunks", chunks));
}

MinMaxLevel VolumeReader::min_max(int level) const {
  const Hdf5Use hdf5;
  const VolumeFile& volume = state_->volume;
  require(level >= 0 && level < min_max_levels(volume.grid.dims), "a level of the min/max pyramid");
  const survey::Index n = min_max_dims(volume.grid.dims, level);
  const Extent extent{static_cast<hsize_t>(n[0]), 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])};
  const std::string name = fmt::format("{}/{}", kMinMax, level);
  const Handle dataset = open_plain(volume.file.id(), name, H5T_IEEE_F32LE, extent, volume.path);
  const auto plane = static_cast<std::size_t>(n[1] * n[2]);
  std::vector<float> rows(static_cast<std::size_t>(n[0]) * 3 * plane);
  read_slab(dataset.id(), H5T_NATIVE_FLOAT, {0, 0, 0, 0}, extent, rows.data());
  check_hash(dataset.id(), std::as_bytes(std::span(rows)), name, volume.path);

  MinMaxLevel result;
  result.dims = n;
  result.step = std::int64_t{8} << level;
  const std::size_t entries = static_cast<std::size_t>(n[0]) * plane;
  result.min.reserve(entries);
  result.max.reserve(entries);
  result.has_null.reserve(entries);
  for (auto row = rows.begin(); row != rows.end(); row += static_cast<std::ptrdiff_t>(3 * plane)) {
    const auto planes = [&](std::size_t p) { return row + static_cast<std::ptrdiff_t>(p * plane); };
    result.min.insert(result.min.end(), planes(0), planes(1));
    result.max.insert(result.max.end(), planes(1), planes(2));
    for (auto null = planes(2); null != planes(3); ++null) result.has_null.push_back(*null != 0 ? 1 : 0);
  }
  return result;
}

}  // namespace footwall::volume
