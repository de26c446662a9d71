// The layout of a volume file in HDF5's terms: names, types, and the checks that come before any use.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "storage/volume/chunk_grid.h"
#include "storage/volume/hdf5_handle.h"
#include "storage/volume/volume_info.h"

namespace footwall::volume {

inline constexpr const char* kVoxels = "/voxels";
inline constexpr const char* kChecksums = "/checksums";
inline constexpr const char* kLive = "/live";
inline constexpr const char* kMinMax = "/minmax";
inline constexpr const char* kHash = "hash";  // attribute of /live and /minmax/N: hash64 of their values

using Extent = std::vector<hsize_t>;

// A dataset without chunks whose place in the file is fixed at once.
Handle create_plain(hid_t file, const std::string& name, hid_t type, const Extent& extent);
void write_slab(hid_t dataset, hid_t memory_type, const Extent& start, const Extent& count,
                const void* values);
void read_slab(hid_t dataset, hid_t memory_type, const Extent& start, const Extent& count, void* values);
void write_hash(hid_t dataset, std::uint64_t hash);

// A dataset that must have this type and extent and all its bytes in the file; throws kFormat.
Handle open_plain(hid_t file, const std::string& name, hid_t type, const Extent& extent,
                  const std::filesystem::path& path);
// Throws kCorrupt unless the dataset's hash attribute agrees.
void check_hash(hid_t dataset, std::span<const std::byte> values, const std::string& name,
                const std::filesystem::path& path);

// An opened and checked file.
struct VolumeFile {
  std::filesystem::path path;
  VolumeInfo info;
  ChunkGrid grid;
  std::vector<std::uint64_t> hashes;  // of the chunks
  Handle file;
  Handle voxels;
};
VolumeFile open_volume(const std::filesystem::path& path);

// Throws kCorrupt with the chunk's place unless its bytes have their hash.
void check_chunk(const ChunkGrid& grid, std::int64_t number, std::span<const float> values,
                 std::uint64_t expected, const std::filesystem::path& path);
[[noreturn]] void throw_altered(const ChunkGrid& grid, std::int64_t number, const std::filesystem::path& path,
                                const std::string& how);

}  // namespace footwall::volume
