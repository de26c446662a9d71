// `footwall bench quality`: how well the numbers of a face tell a fault, on synthetic surveys whose faults
// are known.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

struct BenchQualityOptions {
  survey::Index size{256, 256, 256};
  std::uint64_t seed = 1;            // of the first survey; the others take the next ones
  int volumes = 3;                   // surveys, at least 1
  int faces = 100;                   // of each fault and leg in each survey, at least 1
  std::vector<int> legs{8, 16, 32};  // voxels, 4..64
};

// Chances over pairs of a true face and the same face moved by 6 voxels along its normal, to either side:
// how often the true one has the higher number (equal ones count half). NaN where there is no pair.
struct Chances {
  double contrast = 0;
  double discontinuity = 0;  // of the face
  double attribute = 0;      // mean of the discontinuity volume (window 3x3x9) over the face's voxels
  double variance = 0;       // amplitude variance
};

struct QualityOfLeg {
  int leg = 0;
  std::int64_t faces = 0;  // true faces that were found
  std::int64_t pairs = 0;  // of them, those whose numbers are all defined
  Chances chance;
  // Of true faces moved by a known whole number of voxels from -6 to 6, how many `offset` brings back to
  // within one voxel of the truth; NaN where there is none.
  std::int64_t offsets = 0;
  double within_one = 0;
};

struct BenchQualityResult {
  std::vector<QualityOfLeg> legs;
  double seconds = 0;
};

// A true face is a right triangle with two legs of so many voxels, anywhere and any way round on the true
// surface of a fault, its corners on that surface. In the process, without ranks. Throws kUsage for options
// out of their range and for surveys too small to have faults; kCancelled.
BenchQualityResult bench_quality(const BenchQualityOptions& options, const JobContext& job);

}  // namespace footwall::tasks
