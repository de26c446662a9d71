// The statistics of a face as they are defined, slowly: exact rationals, and every neighbour looked up on its
// own.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/extract/face.h"
#include "storage/survey/box.h"

namespace footwall::verify {

struct MomentsByDefinition {
  double mean;      // the double nearest to the rational mean; NaN without values
  double variance;  // the double nearest to the rational sample variance; 0 for at most one value
};

// All values must be finite.
MomentsByDefinition moments_by_definition(std::span<const float> values);

// Value of a voxel of the survey; NaN for nulls.
using ValueAt = std::function<float(const survey::Index&)>;

// The statistics of a face whose voxels inside the survey are `voxels`. max_abs as in extract::Input.
extract::FaceStatistics statistics_by_definition(std::span<const survey::Index> voxels,
                                                 const survey::Index& dims, const ValueAt& value,
                                                 double max_abs, extract::Outside outside);

}  // namespace footwall::verify
