// Discontinuity of a face: 1 - sum(num) / sum(den) over its voxels, num = (sum over the 3x3 traces at the
// same sample)^2, den = m x (sum of their squares); traces that are null there, or outside the survey, drop
// out, m is how many are left, and with m < 4 the voxel drops out. 0 where the traces are alike, towards 1
// where they are not; independent of gain. Each num and den is computed in double, ascending (inline,
// crossline), and rounded to a multiple of 2^-40 of 81 max|V|^2 (ties to even), so that the sums are exact in
// 128-bit integers. Based on: semblance, Marfurt et al., 3-D seismic attributes using a semblance-based
// coherency algorithm, 1998.
#pragma once
#include <cstddef>
#include <cstdint>

#include "engine/extract/statistics/wide_integer.h"

namespace footwall::extract {

struct Discontinuity {
  Int128 num = 0;
  Int128 den = 0;

  void merge(const Discontinuity& other) {
    num += other.num;
    den += other.den;
  }
  // (den - num) / den, at least 0; NaN where den is 0.
  double value() const;
};

// 2^40 / (81 max_abs^2); 0 where max_abs is 0.
double discontinuity_scale(double max_abs);

inline constexpr std::size_t kNeighbours = 9;
inline constexpr std::size_t kWindowBlock = 256;
inline constexpr std::size_t kWindowStride = kWindowBlock + 16;

// The 3x3 neighbours of up to 256 voxels: value[3 * (di + 1) + (dj + 1)][n], NaN where null or outside.
struct Windows {
  alignas(64) float value[kNeighbours][kWindowStride];
};

// Adds the first n windows; overwrites what follows them up to the stride. Throws Error kCorrupt where a
// value is so far above the max_abs behind `scale` that the fixed point would overflow.
void fold_windows(Windows& windows, std::size_t n, double scale, Discontinuity& into);

// Values in memory, and how far apart neighbours along inlines and crosslines stand.
struct Surroundings {
  const float* data = nullptr;
  std::int64_t i_stride = 0;
  std::int64_t j_stride = 0;
};
// The same for n <= kWindowBlock voxels by their places in `in.data`, which must have their neighbours, too.
// Windows without a null are folded where they stand; `room` is for the others.
void fold_around(const Surroundings& in, const std::int64_t* places, std::size_t n, double scale,
                 Windows& room, Discontinuity& into);

}  // namespace footwall::extract
