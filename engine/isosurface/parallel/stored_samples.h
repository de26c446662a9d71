// Samples of a volume file for extract_parallel(): each rank reads the boxes that it needs.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/extract_parallel.h"
#include "storage/volume/min_max.h"
#include "storage/volume/volume_reader_parallel.h"

namespace footwall::isosurface {

class StoredSamples {
 public:
  // Collective. Rank 0 reads the pyramid and hands it out; throws the same Error on all ranks (see
  // VolumeReader). Memory: 9/2048 of the volume for the pyramid.
  StoredSamples(comm::Communicator& world, const std::filesystem::path& path);
  StoredSamples(const StoredSamples&) = delete;
  StoredSamples& operator=(const StoredSamples&) = delete;

  const volume::VolumeInfo& info() const { return reader_.info(); }
  const Bricks& bricks() const { return bricks_; }
  // Reads the box, into memory that the next call overwrites. Not collective; throws kCorrupt, kMemory.
  Field read(const survey::Box& samples);
  FieldOf field_of() {
    return [this](const survey::Box& samples) { return read(samples); };
  }
  // Of the pyramid, and of the box that was read last.
  std::int64_t memory_bytes() const;
  // Gives the last box back; the next read() makes room anew.
  void release() { values_.release(); }
  std::int64_t bytes_read() const { return bytes_read_; }  // whole chunks

 private:
  volume::ParallelVolumeReader reader_;
  volume::MinMaxLevel level_;
  Bricks bricks_;
  PageVector<float> values_;
  std::int64_t bytes_read_ = 0;
};

}  // namespace footwall::isosurface
