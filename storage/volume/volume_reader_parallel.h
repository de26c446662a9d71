// Reads a volume file by N ranks at once through MPI-IO, each rank its own box; the chunks are checked as in
// VolumeReader.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "storage/volume/volume_info.h"

namespace footwall::volume {

// MPI-IO hints by name, e.g. {"romio_cb_read", "enable"}; unknown ones are ignored by MPI.
using IoHints = std::map<std::string, std::string>;

// What the last read did on this rank, as HDF5 reports it.
struct IoReport {
  enum class Mode : std::uint8_t { kNone, kIndependent, kCollective };
  Mode asked = Mode::kNone;
  Mode actual =
      Mode::kNone;  // the weakest mode of all transfers; kNone if this rank took part in no transfer
  bool linked_chunks = false;  // all chunks of a transfer went into one MPI-IO call (H5D_MPIO_LINK_CHUNK)
  std::uint32_t no_collective_cause = 0;  // H5Pget_mpio_no_collective_cause, 0 = none
  std::int64_t transfers = 0;             // of this rank, the empty ones of a collective read included
  std::int64_t chunks = 0;                // read by this rank
  std::int64_t bytes = 0;                 // read by this rank: whole chunks
};

class ParallelVolumeReader {
 public:
  // Collective over comm (duplicated; ranks need the same path and hints). Rank 0 opens and checks the file
  // and tells the others; throws the same Error on all ranks (see VolumeReader). Destroy it on all ranks,
  // before MPI_Finalize.
  ParallelVolumeReader(MPI_Comm comm, const std::filesystem::path& path, const IoHints& hints = {});
  ~ParallelVolumeReader();
  ParallelVolumeReader(ParallelVolumeReader&&) noexcept;
  ParallelVolumeReader& operator=(ParallelVolumeReader&&) noexcept;

  const VolumeInfo& info() const;

  // Collective: every rank calls it, ranks that need nothing with an empty box. Arguments and result as
  // VolumeReader::read. If a box is wrong or a chunk was altered on any rank, all ranks throw the Error of
  // the lowest such rank.
  void read_collective(const survey::Box& box, std::span<float> out);

  // Not collective: no communication; a rank that fails throws alone (the caller must agree before its next
  // collective). Reads faster than the collective one on local disks and page cache.
  void read_independent(const survey::Box& box, std::span<float> out);

  // Of this rank's last read.
  const IoReport& last_io() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::volume
