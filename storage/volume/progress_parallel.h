// How far all ranks together are, and whether one of them gave up, told without anyone waiting for anyone.
#pragma once
#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>

#include "storage/volume/mpi_agreement.h"

namespace footwall::volume {

// Rounds of non-blocking sums. A round ends when every rank has entered it; a rank enters the next one when
// it finds the last one ended, so that a quick rank works on meanwhile, and all find the same in each round.
class CommonProgress {
 public:
  // Collective. comm must outlive this; until finish() nothing else may be sent over it.
  explicit CommonProgress(const OwnCommunicator& comm);
  CommonProgress(const CommonProgress&) = delete;
  CommonProgress& operator=(const CommonProgress&) = delete;

  // Call often, while at work: tells the others that `done` of this rank's work is done. Does not wait.
  void tell(std::int64_t done);
  // The work done by all ranks, as far as known here; never falls.
  std::int64_t done() const { return sums_[kDone]; }
  // Whether some rank failed: then this rank's work is in vain.
  bool failed() const { return sums_[kFailed] > 0; }

  // Call once, on every rank, also on one that failed (good = false): waits until all ranks have come here or
  // one has failed. `each_round` is called when more is known; if it returns false, this rank has failed.
  void finish(std::int64_t done, bool good, const std::function<bool()>& each_round);

 private:
  enum Number : std::size_t { kDone, kFailed, kFinished, kNumbers };
  void enter(std::int64_t done, bool good, bool finished);
  void leave();  // waits for the end of the round at hand

  const OwnCommunicator& comm_;
  MPI_Request round_ = MPI_REQUEST_NULL;
  std::array<std::int64_t, kNumbers> mine_{};
  std::array<std::int64_t, kNumbers> arriving_{};
  std::array<std::int64_t, kNumbers> sums_{};  // of the last round that ended
};

}  // namespace footwall::volume
