#include "storage/volume/volume_tables.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "storage/volume/description.h"
#include "storage/volume/disk_room.h"
#include "storage/volume/preamble.h"
#include "storage/volume/volume_file.h"

namespace footwall::volume {
namespace {

void write_preamble(const std::filesystem::path& path, const Preamble& preamble) {
  const std::string text = encoded(preamble);
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw io_error("open", path, errno);
  const ssize_t written = ::pwrite(descriptor, text.data(), text.size(), 0);
  const int failure = errno;
  ::close(descriptor);
  if (written != static_cast<ssize_t>(text.size())) throw io_error("write", path, failure);
}

}  // namespace

VolumeTables::VolumeTables(const std::filesystem::path& path, const ChunkGrid& grid)
    : path_(path), grid_(grid) {
  const Hdf5Use hdf5;
  create_file();  // finds out whether there is room
  create_datasets();
}

void VolumeTables::create_file() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The newer layout finds chunks by arithmetic instead of a tree, and guards its own tables with checksums.
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_alignment(access.id(), 1 << 16, 1 << 12);
  H5Pset_file_locking(access.id(), false, true);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation.id(), Preamble::kSize);
  H5Pset_obj_track_times(creation.id(), false);
  file_ = Handle(H5Fcreate(path_.c_str(), H5F_ACC_EXCL, creation.id(), access.id()), H5Fclose);
  if (!file_) throw_hdf5(ErrorCode::kIo, fmt::format("cannot create {}", path_.string()));
  reserve(path_, expected_bytes(grid_));
}

void VolumeTables::create_datasets() {
  const auto size = [&](int axis) { return static_cast<hsize_t>(grid_.dims[axis]); };
  const survey::Index n = min_max_dims(grid_.dims, 0);
  {
    const Handle plan(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(plan.id(), false);
    const Handle group(H5Gcreate2(file_.id(), kMinMax, H5P_DEFAULT, plan.id(), H5P_DEFAULT), H5Gclose);
    if (!group) throw_hdf5(ErrorCode::kIo, "cannot create the min/max pyramid");
  }
  live_ = create_plain(file_.id(), kLive, H5T_STD_U8LE, {size(0), size(1)});
  level0_ =
      create_plain(file_.id(), fmt::format("{}/0", kMinMax), H5T_IEEE_F32LE,
                   {static_cast<hsize_t>(n[0]), 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])});

  const Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  hsize_t chunk[3];
  for (int axis = 0; axis < 3; ++axis) chunk[axis] = static_cast<hsize_t>(grid_.chunk[axis]);
  H5Pset_chunk(plan.id(), 3, chunk);
  H5Pset_obj_track_times(plan.id(), false);
  H5Pset_alloc_time(plan.id(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(plan.id(), H5D_FILL_TIME_NEVER);
  const hsize_t dims[3] = {size(0), size(1), size(2)};
  const Handle space(H5Screate_simple(3, dims, nullptr), H5Sclose);
  voxels_ =
      Handle(H5Dcreate2(file_.id(), kVoxels, H5T_IEEE_F32LE, space.id(), H5P_DEFAULT, plan.id(), H5P_DEFAULT),
             H5Dclose);
  if (!voxels_) throw_hdf5(ErrorCode::kIo, "cannot create the voxels");
  const hsize_t first[3] = {0, 0, 0};
  haddr_t address = HADDR_UNDEF;
  hsize_t bytes = 0;
  unsigned filters = 0;
  if (H5Dget_chunk_info_by_coord(voxels_.id(), first, &filters, &address, &bytes) < 0 ||
      address == HADDR_UNDEF) {
    throw_hdf5(ErrorCode::kInternal, "HDF5 does not say where the voxels are");
  }
  voxels_at_ = static_cast<std::int64_t>(address) + Preamble::kSize;
}

void VolumeTables::add_live(const survey::Box& strip, std::span<const std::uint8_t> mask) {
  require(mask.size() == static_cast<std::size_t>(strip.size(0) * strip.size(1)), "the mask of a strip");
  const std::int64_t across = grid_.dims[1];
  layer_.resize(static_cast<std::size_t>(strip.size(0) * across));
  for (std::int64_t i = 0; i < strip.size(0); ++i) {
    std::copy_n(mask.data() + i * strip.size(1), strip.size(1), layer_.data() + i * across + strip.lo[1]);
  }
  live_traces_ += std::count(mask.begin(), mask.end(), std::uint8_t{1});
  if (strip.hi[1] < across) return;
  live_hash_.add(std::as_bytes(std::span(layer_)));
  const Hdf5Use hdf5;
  write_slab(live_.id(), H5T_NATIVE_UINT8, {static_cast<hsize_t>(strip.lo[0]), 0},
             {static_cast<hsize_t>(strip.size(0)), static_cast<hsize_t>(across)}, layer_.data());
}

void VolumeTables::add_min_max(const MinMaxRow& row) {
  const survey::Index n = min_max_dims(grid_.dims, 0);
  min_max_hash_.add(std::as_bytes(std::span(row)));
  const Hdf5Use hdf5;
  write_slab(level0_.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(min_max_rows_), 0, 0, 0},
             {1, 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])}, row.data());
  ++min_max_rows_;
}

void VolumeTables::write_coarser_levels() {
  const int levels = min_max_levels(grid_.dims);
  for (int level = 1; level < levels; ++level) {
    const survey::Index from = min_max_dims(grid_.dims, level - 1);
    const survey::Index n = min_max_dims(grid_.dims, level);
    const Handle finer = open_dataset(file_.id(), fmt::format("{}/{}", kMinMax, level - 1), path_);
    const Extent row_from{1, 3, static_cast<hsize_t>(from[1]), static_cast<hsize_t>(from[2])};
    const Extent row{1, 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])};
    const Handle dataset = create_plain(file_.id(), fmt::format("{}/{}", kMinMax, level), H5T_IEEE_F32LE,
                                        {static_cast<hsize_t>(n[0]), 3, row[2], row[3]});
    Hasher hasher;
    MinMaxRow read = empty_row(from[1] * from[2]);
    for (std::int64_t a = 0; a < n[0]; ++a) {
      MinMaxRow both = empty_row(n[1] * n[2]);
      for (std::int64_t child = 2 * a; child < std::min(2 * a + 2, from[0]); ++child) {
        read_slab(finer.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(child), 0, 0, 0}, row_from,
                  read.data());
        merge_row(both, halved(read, from[1], from[2]));
      }
      hasher.add(std::as_bytes(std::span(both)));
      write_slab(dataset.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(a), 0, 0, 0}, row, both.data());
    }
    write_hash(dataset.id(), hasher.value());
  }
}

void VolumeTables::finish(VolumeInfo& info, std::span<const std::uint64_t> hashes,
                          SampleStatistics& statistics) {
  require(hashes.size() == static_cast<std::size_t>(grid_.count()), "a hash for each chunk");
  require(min_max_rows_ == min_max_dims(grid_.dims, 0)[0], "every row of the pyramid");
  const Hdf5Use hdf5;
  write_hash(live_.id(), live_hash_.value());
  write_hash(level0_.id(), min_max_hash_.value());
  write_coarser_levels();

  const auto chunks = static_cast<hsize_t>(grid_.count());
  Handle table = create_plain(file_.id(), kChecksums, H5T_STD_U64LE, {chunks});
  write_slab(table.id(), H5T_NATIVE_UINT64, {0}, {chunks}, hashes.data());
  info.checksum = hash64(std::as_bytes(hashes));
  info.statistics = statistics.result(live_traces_);
  for (const auto& [name, text] : describe(info)) write_attribute(file_.id(), name, text);

  const bool closed = table.reset() && level0_.reset() && live_.reset() && voxels_.reset() && file_.reset();
  if (!closed) throw_hdf5(ErrorCode::kIo, "cannot write the volume's tables", "is the disk full?");
  info.bytes = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  write_preamble(path_, {info.bytes, voxels_at_, grid_});
}

}  // namespace footwall::volume
