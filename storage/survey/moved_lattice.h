// Between the index spaces of a survey and of a volume that covers a part of it.
#pragma once
#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::survey {

// Whole voxels further. Throws Error kInvalid where what moves comes to 2^23 voxels or more from the origin.
LatticePoint moved(const LatticePoint& point, const Index& voxels);

// What stands in the survey's index space, seen by a volume whose first voxel is the survey's voxel `origin`;
// and back.
LatticeTriangle in_volume(const LatticeTriangle& triangle, const Index& origin);
LatticeTriangle in_survey(const LatticeTriangle& triangle, const Index& origin);

}  // namespace footwall::survey
