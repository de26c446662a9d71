// The slow, obvious definition of VOXELIZE: every voxel of a box is tested on its own, in 128-bit integers.
#pragma once
#include <vector>

#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::verify {

// Whether the closed unit cube of the voxel meets the closed triangle: the separating-axis test on all 13
// axes (Akenine-Moller, Fast 3D triangle-box overlap testing, 2001), in exact integers. Any lattice triangle,
// also segments and points; any voxel whose index lies within +-2^24.
bool meets(const survey::LatticeTriangle& triangle, const survey::Index& voxel);

// All voxels of the box that meet the triangle, in order of memory (inline, crossline, sample). O(box).
std::vector<survey::Index> voxels_by_definition(const survey::LatticeTriangle& triangle,
                                                const survey::Box& box);

}  // namespace footwall::verify
