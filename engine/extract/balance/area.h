// Areas of faces as whole numbers, so that unlike processors balance alike.
// Based on: seed 004, section 4.1 (a node's load is the area of its faces); differs in the fixed point.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// An area in units of 2^-16 voxel^2 of index space: one unit is the square of the vertices' lattice spacing.
using FixedArea = std::int64_t;
inline constexpr FixedArea kAreaPerVoxel2 = FixedArea{1} << 16;

// The area of a triangle, rounded down to the unit; the part outside the survey counts too, 0 for one without
// area. Exact integer arithmetic. No more than 2^61 (2^45 voxel^2).
FixedArea fixed_area(const survey::LatticeTriangle& triangle);

// The areas of faces, in their order. Each counts for at most 2^61 / faces, so that their sum, and twice
// their sum, fit the type whatever the triangles.
std::vector<FixedArea> fixed_areas(std::span<const Face> faces);

inline double voxel2(FixedArea area) {
  return static_cast<double>(area) / static_cast<double>(kAreaPerVoxel2);
}

// The standard deviation of loads about their mean, in voxel^2: seed 004, equation 5.4, for one extraction
// (divisor ranks - 1; 0 for one rank). For reports: floating point.
double load_deviation(std::span<const FixedArea> loads);

// The loads of `ranks` ranks, given the responsible rank of each face.
std::vector<FixedArea> loads_of(std::span<const FixedArea> areas, std::span<const int> responsible,
                                int ranks);

}  // namespace footwall::extract
