// What computing costs on this machine, from a short run of the real code over a small synthetic volume.
#pragma once
#include "engine/extract/cost/rates.h"

namespace footwall::extract {

// The rates of voxels, faces and whole-face computations on the calling thread, in its own processor time, so
// that other programs on the core do not count; those of messages stay 0. Takes about `seconds` and a few
// hundredths more. Throws std::bad_alloc.
MachineRates measure_computing(double seconds);

// s in which one of `threads` threads that run at once folds a voxel, by the clock. Throws std::bad_alloc.
double measure_folding(int threads, double seconds);

}  // namespace footwall::extract
