// A volume on another grid on its way in: another number of lines and samples over the same extent, or the
// grid of the project's survey.
// Method: separable; Keys' six-point cubic convolution (exact for cubic polynomials), stretched by the ratio
// of the spacings where the new grid is coarser, so that it also limits the band. Its weights are corrected
// so that constant and linear fields come out exactly, also at the edges and for every ratio.
// Nulls: a new sample is null where the nearest old one along an axis is; other nulls among its six are left
// out and a linear hat over the rest takes the kernel's place. A new trace is live where the nearest old one
// is.
// Based on: R. G. Keys, Cubic convolution interpolation for digital image processing, 1981 (the fourth-order
// kernel); the stretching, the correction and the nulls are our own.
#pragma once
#include <array>

#include "engine/tasks/add_volume.h"

namespace footwall::tasks {

// Where the new grid lies along one axis: old index = offset + n * step.
struct AxisPlace {
  double offset = 0;
  double step = 1;
  std::int64_t old_count = 1;
  std::int64_t new_count = 1;
};
struct Regrid {
  survey::Geometry geometry;  // of the new grid
  std::array<AxisPlace, 3> places;
};

// dims: inlines, crosslines, samples; the first and last of each axis stay where they are. Line numbers keep
// counting where the new lines have whole numbers, else they are numbered from 1 and `assumed` says so.
// Throws kInvalid where an axis of several becomes one, or of one several.
Regrid regridded(const survey::Geometry& geometry, const survey::Index& dims);
// The part of the survey's grid that lies inside `part`, by X and Y (by line numbers where the part has no
// coordinates of its own) and z. Throws kInvalid where domain or unit differ, the lines do not run along the
// survey's, or nothing lies inside.
Regrid on_survey(const survey::Geometry& survey, const survey::Geometry& part);

// grid: made by one of the two above from source.geometry. "resample" is added to the provenance. Memory
// while filling: the old traces of one inline under a block, and the block's new traces for each of the
// 6 x ratio inlines around it.
VolumeSource resampled(VolumeSource source, const Regrid& grid);

}  // namespace footwall::tasks
