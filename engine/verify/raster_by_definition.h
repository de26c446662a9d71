// The slow, obvious forms of the two voxelizers that are kept for comparison with the papers.
#pragma once
#include <array>
#include <vector>

#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::verify {

// One pixel of the rotated triangle: where it lies in index space.
using Position = std::array<long double, 3>;

struct RotatedPixels {
  std::vector<Position> position;  // in raster order, x then y
  // A vertex came to lie within 1e-5 of the middle between two pixels, so that the last bits of an arc cosine
  // decide which pixels there are.
  bool doubtful = false;
};

// The formulas of seed 004, (3.31) to (3.47), with arc cosines, sines and cosines, and the loop of appendix
// E.3.2 over sets of edge pixels; with the corrections told in engine/voxelize/rotated.h.
RotatedPixels rotated_by_formulas(const survey::LatticeTriangle& triangle);

// Whether `voxels` (inline, crossline, sample each) are what the pixels round to, one after the other, those
// outside the triangle's bounding voxels left out; a coordinate within 1e-5 of the middle between two voxels
// may have gone either way.
bool are_rounded(const RotatedPixels& pixels, const std::vector<std::array<std::int32_t, 3>>& voxels,
                 const survey::LatticeTriangle& triangle);

// Kaufman's voxels as engine/voxelize/kaufman.h defines them, each voxel of the box tested on its own; in
// order of memory. Not for triangles without area.
std::vector<survey::Index> kaufman_by_definition(const survey::LatticeTriangle& triangle,
                                                 const survey::Box& box);

}  // namespace footwall::verify
