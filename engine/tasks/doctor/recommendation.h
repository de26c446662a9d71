// How many ranks, of how many threads, this machine should run: the choice that has to be made before an
// extraction starts (seed 004, section 6.4.1, the last of its parameters).
#pragma once
#include <span>
#include <vector>

#include "engine/extract/cost/rates.h"
#include "engine/tasks/doctor/finding.h"

namespace footwall::tasks {

struct Shape {
  int ranks = 1, threads = 1;
  double seconds = 0;  // predicted for an extraction like those of the seed's benchmark 2
};

// Every way to use `cores` cores with ranks x threads, the fastest first, among equals the one with more
// ranks: those read in parallel, too. rates: of ranks that run at once. slowdown[t - 1]: of a thread among t,
// against one alone, at least for t up to cores. Throws kInternal for cores < 1.
std::vector<Shape> shapes(const extract::MachineRates& rates, int cores, std::span<const double> slowdown);

// Measures the threads of this process and puts the best shape and the rates into words.
Finding recommend_shape(const extract::MachineRates& rates);

}  // namespace footwall::tasks
