// Contrast, offset and the discontinuity of single voxels as they are defined, slowly: every shifted face is
// voxelized cube by cube.
#pragma once
#include <span>

#include "engine/verify/statistics_by_definition.h"

namespace footwall::verify {

struct ContrastByDefinition {
  double contrast = extract::kUndefined;
  double offset_voxels = extract::kUndefined;
  double offset_score = extract::kUndefined;
};

// side: +1 or -1, from side_by_definition() of the face's fault.
ContrastByDefinition contrast_by_definition(const survey::LatticeTriangle& triangle,
                                            const survey::Index& dims, const ValueAt& value, double max_abs,
                                            int side);

// The sign of the first component that is not zero of the sum of a fault's face normals; +1 for none. For
// coordinates below 2^20.
int side_by_definition(std::span<const extract::Face> faces);

// The voxels inside the survey that a triangle cuts.
std::vector<survey::Index> voxels_in_survey(const survey::LatticeTriangle& triangle,
                                            const survey::Index& dims);

// The discontinuity attribute of one voxel in a window of so many inlines, crosslines and samples; NaN =
// null.
float attribute_by_definition(const survey::Index& voxel, const survey::Index& window,
                              const survey::Index& dims, const ValueAt& value, double max_abs);

}  // namespace footwall::verify
