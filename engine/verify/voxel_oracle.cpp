#include "engine/verify/voxel_oracle.h"

#include <algorithm>
#include <array>

namespace footwall::verify {
namespace {

__extension__ typedef __int128 Int128;
using Vector = std::array<Int128, 3>;

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Int128 dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Int128 magnitude(Int128 a) {
  return a < 0 ? -a : a;
}

// Whether the shadows of triangle and cube (centred on the origin) on the axis touch. A zero axis separates
// nothing.
bool shadows_touch(const Vector& axis, const std::array<Vector, 3>& corners) {
  const Int128 reach =
      survey::kLatticePerVoxel / 2 * (magnitude(axis[0]) + magnitude(axis[1]) + magnitude(axis[2]));
  const std::array<Int128, 3> at = {dot(axis, corners[0]), dot(axis, corners[1]), dot(axis, corners[2])};
  return std::min({at[0], at[1], at[2]}) <= reach && std::max({at[0], at[1], at[2]}) >= -reach;
}

}  // namespace

bool meets(const survey::LatticeTriangle& triangle, const survey::Index& voxel) {
  std::array<Vector, 3> corners;
  for (int n = 0; n < 3; ++n) {
    corners[n] = {Int128{triangle[n].i} - voxel[0] * survey::kLatticePerVoxel,
                  Int128{triangle[n].j} - voxel[1] * survey::kLatticePerVoxel,
                  Int128{triangle[n].k} - voxel[2] * survey::kLatticePerVoxel};
  }
  const std::array<Vector, 3> edges = {minus(corners[1], corners[0]), minus(corners[2], corners[1]),
                                       minus(corners[0], corners[2])};
  const std::array<Vector, 3> units = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  for (const Vector& unit : units) {
    if (!shadows_touch(unit, corners)) return false;
    for (const Vector& edge : edges) {
      if (!shadows_touch(cross(edge, unit), corners)) return false;
    }
  }
  return shadows_touch(cross(edges[0], edges[1]), corners);
}

std::vector<survey::Index> voxels_by_definition(const survey::LatticeTriangle& triangle,
                                                const survey::Box& box) {
  std::vector<survey::Index> voxels;
  survey::Index voxel;
  for (voxel[0] = box.lo[0]; voxel[0] < box.hi[0]; ++voxel[0]) {
    for (voxel[1] = box.lo[1]; voxel[1] < box.hi[1]; ++voxel[1]) {
      for (voxel[2] = box.lo[2]; voxel[2] < box.hi[2]; ++voxel[2]) {
        if (meets(triangle, voxel)) voxels.push_back(voxel);
      }
    }
  }
  return voxels;
}

}  // namespace footwall::verify
