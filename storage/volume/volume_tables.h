// The HDF5 side of a volume file while it is made: everything but the chunks' contents.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "storage/base/hash.h"
#include "storage/volume/chunk_grid.h"
#include "storage/volume/hdf5_handle.h"
#include "storage/volume/min_max_builder.h"
#include "storage/volume/statistics.h"
#include "storage/volume/volume_info.h"

namespace footwall::volume {

class VolumeTables {
 public:
  // Makes the file (there must be none), takes the room on the disk for all of it, and fixes the places of
  // its datasets. Throws kIo, kInvalid for what no file can hold.
  VolumeTables(const std::filesystem::path& path, const ChunkGrid& grid);

  // Where the first chunk goes, in bytes; the others follow without gaps.
  std::int64_t voxels_at() const { return voxels_at_; }

  // A part of the live mask, [inline][crossline] of `strip`: strips come in order, inlines slowest, each of
  // whole blocks of one range of chunk-inlines. A layer is written when it is whole.
  void add_live(const survey::Box& strip, std::span<const std::uint8_t> mask);
  // The next row of the min/max pyramid's level 0.
  void add_min_max(const MinMaxRow& row);
  // When all is added: writes what is left, closes the file and completes `info`. `hashes`: of all chunks.
  void finish(VolumeInfo& info, std::span<const std::uint64_t> hashes, SampleStatistics& statistics);

 private:
  void create_file();
  void create_datasets();
  void write_coarser_levels();

  std::filesystem::path path_;
  ChunkGrid grid_;
  std::int64_t voxels_at_ = 0;
  std::int64_t live_traces_ = 0;
  std::vector<std::uint8_t> layer_;  // of the live mask, [inline][crossline] of all crosslines
  Hasher live_hash_;
  Hasher min_max_hash_;
  std::int64_t min_max_rows_ = 0;
  Handle file_;  // before the datasets: they are closed first
  Handle voxels_;
  Handle live_;
  Handle level0_;
};

}  // namespace footwall::volume
