#include "engine/extract/exchange/phases.h"

#include <omp.h>

namespace footwall::extract {

Phases::Phases(const Setup& setup) : setup_(setup), since_(omp_get_wtime()) {}

void Phases::enter(double Seconds::*phase) {
  const double now = omp_get_wtime();
  seconds_.*phase_ += now - since_;
  since_ = now;
  phase_ = phase;
}

void Phases::meet() {
  if (!apart() || setup_.world.size() == 1) return;
  double Seconds::*const before = phase_;
  enter(&Seconds::wait);
  comm::check(MPI_Barrier(setup_.world.get()), "MPI_Barrier");
  enter(before);
}

const Seconds& Phases::end() {
  enter(phase_);
  return seconds_;
}

}  // namespace footwall::extract
