// The side that a fault's normal points to, which the sign of an offset counts along: that of the mean normal
// of its faces whose first component that is not zero is positive.
#pragma once
#include <array>
#include <span>

#include "engine/extract/statistics/wide_integer.h"
#include "storage/survey/lattice.h"

namespace footwall::extract {

// The cross product of two edges, exactly: below 2^66 on each axis. Its sign follows the winding.
std::array<Int128, 3> exact_normal(const survey::LatticeTriangle& triangle);

// 1 where the sum of a fault's exact normals points to the fault's side (or is zero: then the windings
// decide), -1 where it points to the other.
int side_of(const std::array<Int128, 3>& sum);

// The same from all faces of a fault: the normal of a winding times this points to the fault's side.
int fault_side(std::span<const survey::LatticeTriangle> faces);

}  // namespace footwall::extract
