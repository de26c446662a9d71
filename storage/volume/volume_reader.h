// Reads a volume file in one process. Every chunk that is touched is read whole and checked against its hash.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/volume/min_max.h"
#include "storage/volume/volume_info.h"

namespace footwall::volume {

// Open read-only, without HDF5's file locking. One reader serves one thread at a time; several readers and
// writers, of the same file or others, may be at work on threads of their own: their calls of HDF5 take
// turns, one chunk at a time. Memory: 8 bytes a chunk of the volume, and one chunk.
class VolumeReader {
 public:
  // Throws kNotFound; kFormat (not a volume of ours, or one that breaks the format's rules); kCorrupt
  // (truncated, with the place of the first lost chunk, or damaged); kUnsupported (a newer format); kIo.
  explicit VolumeReader(const std::filesystem::path& path);
  ~VolumeReader();
  VolumeReader(VolumeReader&&) noexcept;
  VolumeReader& operator=(VolumeReader&&) noexcept;

  const VolumeInfo& info() const;
  const std::filesystem::path& path() const;

  // [inline][crossline]: 1 where there is a trace. Throws kCorrupt if it was altered.
  std::vector<std::uint8_t> live_mask() const;

  // The samples of `box` as [inline][crossline][sample] into `out` (out.size() == box.count()); nulls and
  // dead traces are quiet NaN, all else is finite. An empty box reads nothing. Throws kCorrupt naming the
  // chunk's place if a touched chunk was altered or is gone (`out` is then undefined); kInternal for a box
  // that leaves the volume.
  void read(const survey::Box& box, std::span<float> out) const;

  // Reads the whole file and checks every hash; kCorrupt names the first altered chunk and how many there
  // are. Cancel is looked at between chunks.
  void verify(const JobContext& job) const;

  // Level 0 has the finest entries; throws kInternal outside 0 .. min_max_levels(dims) - 1, kCorrupt if
  // altered.
  MinMaxLevel min_max(int level) const;

  // The hash of every chunk, in the order of chunks [inline][crossline][sample].
  std::span<const std::uint64_t> chunk_hashes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::volume
