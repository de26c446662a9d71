// The part files of a job, shared out over the first ranks, its writers: the part of fault n is read and
// written by rank n mod writers.
#pragma once
#include <optional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/face_blobs.h"
#include "engine/extract/fault_statistics.h"
#include "engine/session/job.h"

namespace footwall::session {

class SharedParts {
 public:
  // Collective. `job` must outlive this. Looks for the whole parts of an earlier run that belong to this very
  // job (the others, also damaged ones, are as good as not there), and brings their statistics to rank 0.
  SharedParts(const comm::Communicator& world, const Job& job, int writers);

  bool done(std::size_t fault) const { return done_[fault]; }
  bool reused(std::size_t fault) const { return reused_[fault]; }
  // The next faults that are not done, with `faces` faces or a little more; empty when all are.
  std::vector<std::size_t> next_group(std::size_t faces) const;
  // Collective: writes the parts of `faults`. `statistics` and `blobs`, on rank 0, have those of their faces
  // one after the other, `wholes` those of each fault in any order; they are not looked at elsewhere. Throws
  // kIo on all ranks.
  void write(const std::vector<std::size_t>& faults, std::span<const extract::FaceStatistics> statistics,
             std::span<const extract::FaceBlobs> blobs, std::span<const extract::FaultStatistics> wholes);
  // On rank 0: the statistics of every fault that is done, one per face.
  const std::vector<std::vector<extract::FaceStatistics>>& statistics() const { return statistics_; }
  // On rank 0: those over the distinct voxels of every fault that is done.
  const std::vector<extract::FaceStatistics>& wholes() const { return wholes_; }

 private:
  int writer_of(std::size_t fault) const {
    return static_cast<int>(fault % static_cast<std::size_t>(writers_));
  }

  comm::Communicator world_;
  const Job& job_;
  int writers_;
  std::vector<bool> done_, reused_;
  std::vector<std::vector<extract::FaceStatistics>> statistics_;
  std::vector<extract::FaceStatistics> wholes_;
};

}  // namespace footwall::session
