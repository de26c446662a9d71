#include "storage/volume/progress_parallel.h"

namespace footwall::volume {

CommonProgress::CommonProgress(const OwnCommunicator& comm) : comm_(comm) {
  enter(0, true, false);
}

void CommonProgress::enter(std::int64_t done, bool good, bool finished) {
  mine_ = {done, good ? 0 : 1, finished ? 1 : 0};
  check_mpi(
      MPI_Iallreduce(mine_.data(), arriving_.data(), kNumbers, MPI_INT64_T, MPI_SUM, comm_.get(), &round_),
      "MPI_Iallreduce");
}

void CommonProgress::leave() {
  check_mpi(MPI_Wait(&round_, MPI_STATUS_IGNORE), "MPI_Wait");
  sums_ = arriving_;
}

void CommonProgress::tell(std::int64_t done) {
  if (failed()) return;
  int ended = 0;
  check_mpi(MPI_Test(&round_, &ended, MPI_STATUS_IGNORE), "MPI_Test");
  if (ended == 0) return;
  sums_ = arriving_;
  if (!failed()) enter(done, true, false);
}

void CommonProgress::finish(std::int64_t done, bool good, const std::function<bool()>& each_round) {
  // Who has found a failure has left the last round; all others are in the same round.
  if (failed()) return;
  for (leave(); !failed() && sums_[kFinished] < comm_.size(); leave()) {
    good = each_round() && good;
    enter(done, good, true);
  }
}

}  // namespace footwall::volume
