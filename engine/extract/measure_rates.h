// The rates of this machine, from a short run of the real code on a small synthetic volume.
#pragma once
#include "engine/comm/communicator.h"
#include "engine/extract/cost/rates.h"

namespace footwall::extract {

// What computing costs on the calling thread's core, in its own processor time, so that other programs on the
// core do not count. Leaves what is not of computing at 0. Takes about `seconds`. Not collective. Throws
// std::bad_alloc.
MachineRates measure_computing(double seconds);

// s per voxel folded by each of `threads` threads that run at once.
double measure_folding(int threads, double seconds);

// All of them for these ranks: from the cache folder (cost/rates_file.h) where they are there, else measured
// in about 0.2 s and kept there. The rates of the slowest rank; the same on every rank. Collective.
MachineRates machine_rates(const comm::Communicator& world);

}  // namespace footwall::extract
