#include "storage/survey/moved_lattice.h"

#include <cstdlib>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

constexpr std::int64_t kReach = std::int64_t{1} << 23;  // voxels

std::int32_t moved(std::int32_t at, std::int64_t voxels) {
  if (voxels == 0) return at;
  const bool far = std::abs(voxels) >= 2 * kReach;
  const std::int64_t there = far ? voxels : at + voxels * kLatticePerVoxel;
  if (far || std::abs(there) >= kReach * kLatticePerVoxel) {
    throw Error(ErrorCode::kInvalid, "a position is 2^23 voxels or more from the volume",
                "check the coordinates' unit and the survey's map");
  }
  return static_cast<std::int32_t>(there);
}

LatticeTriangle moved(const LatticeTriangle& triangle, const Index& voxels) {
  return {moved(triangle[0], voxels), moved(triangle[1], voxels), moved(triangle[2], voxels)};
}

}  // namespace

LatticePoint moved(const LatticePoint& point, const Index& voxels) {
  return {moved(point.i, voxels[0]), moved(point.j, voxels[1]), moved(point.k, voxels[2])};
}

LatticeTriangle in_volume(const LatticeTriangle& triangle, const Index& origin) {
  return moved(triangle, Index{-origin[0], -origin[1], -origin[2]});
}

LatticeTriangle in_survey(const LatticeTriangle& triangle, const Index& origin) {
  return moved(triangle, origin);
}

}  // namespace footwall::survey
