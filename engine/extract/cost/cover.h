// How many voxels a face cuts, and how many more when more than the face is asked for, without voxelizing it.
// The blocks of a x b x c voxels around the voxels of a triangle T hold as many voxels as the volume of
// T + box(a, b, c), on average over T's place in the lattice; for a triangle with projected areas P and a
// bounding box with sides e that is (Minkowski's mixed volumes)
//   a b c + (a b e_k + b c e_i + c a e_j) + (a P_jk + b P_ki + c P_ij).
// For a cube of side B and a large face it is B times the face's own voxels: the slab that algorithm `block`
// sends, where seed 004, equation 3.18, has b^3 - b^2.
#pragma once
#include <array>

#include "storage/survey/points.h"

namespace footwall::extract {

// Projected areas and sides of a triangle, in voxels.
struct Shape {
  std::array<double, 3> area{};  // onto the planes across axis 0, 1, 2
  std::array<double, 3> side{};  // of the bounding box
};
Shape shape_of(const survey::LatticeTriangle& triangle);

// The number of voxels with blocks of these sides around each, inside the survey or not; 1 1 1 = the face.
double expected_cover(const Shape& shape, const std::array<double, 3>& block);
// Voxels in the bounding volume.
double expected_bounding(const Shape& shape);

}  // namespace footwall::extract
