// Writes a volume file block by block; the file takes its name only when it is whole and on the disk.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "storage/base/job_context.h"
#include "storage/volume/volume_info.h"

namespace footwall::volume {

// Asked once for every block of chunk-inlines x chunk-crosslines x all samples, inline blocks outermost,
// always from the thread that called write_volume. Puts the samples of `box` as [inline][crossline][sample]
// into `values` and 1 (live) or 0 (no such trace; its samples need not be set) per trace [inline][crossline]
// into `live`. `live` comes filled with 1. NaN, the null value and infinities are null. May throw: the file
// is then given up.
using BlockSource =
    std::function<void(const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live)>;

struct WriteOptions {
  survey::Geometry geometry;
  survey::Index origin{0, 0, 0};
  std::optional<float> null_value;
  Role role = Role::kAmplitude;
  bool high_is_fault = true;
  std::string source;
  std::string provenance_json = "{}";
  std::optional<survey::Index> chunk;  // left out: default_chunk()
};

// The chunk shape that measured best (docs/volume-format.md): 32 x 32 x 32, smaller where the volume is.
survey::Index default_chunk(const survey::Index& dims);

// Streams: while the calling thread asks the source, workers (as many as OpenMP would use, at most 8) clean,
// fold, hash and write the blocks before. What is written does not depend on their number. Memory: as many
// blocks (chunk-inlines x chunk-crosslines x samples x 4 bytes), twice each, as there are workers and one
// more, but no more than 128 MiB where one is not larger; 3 MiB a worker, 8 bytes a chunk, and 9/512 of a
// layer of chunk-inlines. A block larger than 1 GiB is refused (kInvalid); default_chunk() never asks for one
// above 64 MiB where a block of 8 x 8 traces is not already larger. An existing file is replaced only by a
// whole one. Cancel is looked at between blocks. Errors: kInvalid (geometry, chunk, provenance that is not
// JSON), kNotFound (folder), kIo (disk full ...), kCancelled, and what `fill` throws; each leaves no file.
// May run beside other readers and writers, each on a thread of its own: their calls of HDF5 take turns, and
// it holds none of them up while it asks `fill`.
VolumeInfo write_volume(const std::filesystem::path& path, const WriteOptions& options,
                        const BlockSource& fill, const JobContext& job);

}  // namespace footwall::volume
