#include "storage/volume/volume_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>

#include "storage/base/hash.h"
#include "storage/volume/description.h"
#include "storage/volume/preamble.h"

namespace footwall::volume {
namespace {

static_assert(std::endian::native == std::endian::little, "hashes are of little-endian bytes");

constexpr const char* kMend = "restore it from a copy, or import it again";

[[noreturn]] void break_rule(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorCode::kFormat, fmt::format("{} breaks the volume format: {}", path.string(), what));
}

Extent extent_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 0) return {};
  Extent extent(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
  return extent;
}

void check_type(hid_t dataset, hid_t type, const std::string& name, const std::filesystem::path& path) {
  const Handle stored(H5Dget_type(dataset), H5Tclose);
  if (H5Tequal(stored.id(), type) <= 0) break_rule(path, fmt::format("{} has another type of value", name));
}

Description read_description(hid_t file, const std::filesystem::path& path) {
  Description description;
  for (const std::string& name : description_names()) {
    auto text = read_attribute(file, name, path);
    if (!text) break_rule(path, fmt::format("it has no attribute {}", name));
    description.emplace(name, std::move(*text));
  }
  return description;
}

// Selects the slab in a copy of the dataset's space, and calls HDF5's read or write.
template <class Transfer>
bool transfer_slab(hid_t dataset, const Extent& start, const Extent& count, const Transfer& transfer) {
  const Handle file_space(H5Dget_space(dataset), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                            H5Sclose);
  return H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >=
             0 &&
         transfer(memory_space.id(), file_space.id()) >= 0;
}

}  // namespace

Handle create_plain(hid_t file, const std::string& name, hid_t type, const Extent& extent) {
  const Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(plan.id(), false);  // the same volume gives the same bytes
  H5Pset_alloc_time(plan.id(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(plan.id(), H5D_FILL_TIME_NEVER);
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
  Handle dataset(H5Dcreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT, plan.id(), H5P_DEFAULT),
                 H5Dclose);
  if (!dataset) throw_hdf5(ErrorCode::kIo, fmt::format("cannot create {}", name));
  return dataset;
}

void write_slab(hid_t dataset, hid_t memory_type, const Extent& start, const Extent& count,
                const void* values) {
  const bool done = transfer_slab(dataset, start, count, [&](hid_t memory, hid_t file) {
    return H5Dwrite(dataset, memory_type, memory, file, H5P_DEFAULT, values);
  });
  if (!done) throw_hdf5(ErrorCode::kIo, "cannot write the volume's tables");
}

void read_slab(hid_t dataset, hid_t memory_type, const Extent& start, const Extent& count, void* values) {
  const bool done = transfer_slab(dataset, start, count, [&](hid_t memory, hid_t file) {
    return H5Dread(dataset, memory_type, memory, file, H5P_DEFAULT, values);
  });
  if (!done) throw_hdf5(ErrorCode::kCorrupt, "cannot read the volume's tables", kMend);
}

void write_hash(hid_t dataset, std::uint64_t hash) {
  write_attribute(dataset, kHash, fmt::format("\"{}\"", to_hex(hash)));
}

Handle open_plain(hid_t file, const std::string& name, hid_t type, const Extent& extent,
                  const std::filesystem::path& path) {
  Handle dataset = open_dataset(file, name, path);
  check_type(dataset.id(), type, name, path);
  const Extent stored = extent_of(dataset.id());
  if (stored != extent) {
    break_rule(path, fmt::format("{} is {} where {} is needed", name, fmt::join(stored, "x"),
                                 fmt::join(extent, "x")));
  }
  hsize_t bytes = H5Tget_size(type);
  for (const hsize_t n : extent) bytes *= n;
  if (H5Dget_storage_size(dataset.id()) != bytes) break_rule(path, fmt::format("{} is not all there", name));
  return dataset;
}

void check_hash(hid_t dataset, std::span<const std::byte> values, const std::string& name,
                const std::filesystem::path& path) {
  const auto stored = read_attribute(dataset, kHash, path);
  if (!stored || *stored != fmt::format("\"{}\"", to_hex(hash64(values)))) {
    throw Error(ErrorCode::kCorrupt, fmt::format("{} was altered: {} has lost its hash", path.string(), name),
                kMend);
  }
}

VolumeFile open_volume(const std::filesystem::path& path) {
  const Hdf5Use hdf5;
  const Preamble preamble = read_preamble(path);
  VolumeFile volume;
  volume.path = path;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  volume.file = open_file_read_only(path, access.id());
  volume.info = info_from(read_description(volume.file.id(), path), path);

  volume.voxels = open_dataset(volume.file.id(), kVoxels, path);
  check_type(volume.voxels.id(), H5T_IEEE_F32LE, kVoxels, path);
  const Extent dims = extent_of(volume.voxels.id());
  const Handle plan(H5Dget_create_plist(volume.voxels.id()), H5Pclose);
  hsize_t chunk[3] = {0, 0, 0};
  if (dims.size() != 3 || H5Pget_layout(plan.id()) != H5D_CHUNKED || H5Pget_chunk(plan.id(), 3, chunk) != 3) {
    break_rule(path, "/voxels is not a chunked array of three axes");
  }
  // The preamble was checked against overflow and the file's length; all that follows must agree with it.
  volume.grid = preamble.grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (static_cast<std::int64_t>(dims[axis]) != volume.grid.dims[axis] ||
        static_cast<std::int64_t>(chunk[axis]) != volume.grid.chunk[axis] ||
        volume.info.dims[axis] != volume.grid.dims[axis]) {
      break_rule(
          path, fmt::format("/voxels is {} in chunks of {}, its geometry {}, its preamble {} in chunks of {}",
                            fmt::join(dims, "x"), fmt::join(chunk, "x"), fmt::join(volume.info.dims, "x"),
                            fmt::join(volume.grid.dims, "x"), fmt::join(volume.grid.chunk, "x")));
    }
  }
  volume.info.chunk = volume.grid.chunk;
  volume.info.bytes = preamble.bytes;

  const auto chunks = static_cast<hsize_t>(volume.grid.count());
  const Handle table = open_plain(volume.file.id(), kChecksums, H5T_STD_U64LE, {chunks}, path);
  volume.hashes.resize(chunks);
  read_slab(table.id(), H5T_NATIVE_UINT64, {0}, {chunks}, volume.hashes.data());
  if (hash64(std::as_bytes(std::span(volume.hashes))) != volume.info.checksum) {
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} was altered: its table of chunk hashes is damaged", path.string()), kMend);
  }
  return volume;
}

void throw_altered(const ChunkGrid& grid, std::int64_t number, const std::filesystem::path& path,
                   const std::string& how) {
  throw Error(ErrorCode::kCorrupt, fmt::format("{} {} in {}", path.string(), how, place_text(grid, number)),
              kMend);
}

void check_chunk(const ChunkGrid& grid, std::int64_t number, std::span<const float> values,
                 std::uint64_t expected, const std::filesystem::path& path) {
  if (hash64(std::as_bytes(values)) != expected) throw_altered(grid, number, path, "was altered");
}

}  // namespace footwall::volume
