#include "engine/extract/balance/voxel_weights.h"

#include <algorithm>

#include "engine/voxelize/exact.h"

namespace footwall::extract {
namespace {

using Corner = std::array<std::int64_t, 3>;

Corner corner(const survey::LatticePoint& p) {
  return {p.i, p.j, p.k};
}

}  // namespace

std::vector<std::int64_t> voxel_weights(std::span<const Face> faces, const survey::Index& dims) {
  constexpr std::int64_t kVoxel = survey::kLatticePerVoxel;
  voxelize::ExactScratch scratch;
  const survey::Box survey{{0, 0, 0}, dims};
  std::vector<std::int64_t> weights;
  weights.reserve(faces.size());
  for (const Face& face : faces) {
    const std::array<Corner, 3> at{corner(face.triangle[0]), corner(face.triangle[1]),
                                   corner(face.triangle[2])};
    Corner lo{};
    Corner hi{};
    bool inside = true;
    std::int64_t sides = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min({at[0][axis], at[1][axis], at[2][axis]});
      hi[axis] = std::max({at[0][axis], at[1][axis], at[2][axis]});
      inside = inside && 2 * lo[axis] > -kVoxel && 2 * hi[axis] < (2 * dims[axis] - 1) * kVoxel;
      sides += hi[axis] - lo[axis];
    }
    constexpr std::int64_t kWide = std::int64_t{1} << 30;  // products of larger edges might not fit
    if (!inside || sides >= kWide) {
      weights.push_back(voxelize::count(face.triangle, survey, scratch));
      continue;
    }
    std::int64_t doubled = 0;  // twice A (|nx| + |ny| + |nz|), in lattice units
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t a = (n + 1) % 3;
      const std::size_t b = (n + 2) % 3;
      const std::int64_t part =
          (at[1][a] - at[0][a]) * (at[2][b] - at[0][b]) - (at[1][b] - at[0][b]) * (at[2][a] - at[0][a]);
      doubled += part < 0 ? -part : part;
    }
    constexpr std::int64_t kDoubledVoxel = 2 * kVoxel * kVoxel;
    weights.push_back((doubled + 2 * kVoxel * sides + kDoubledVoxel + kDoubledVoxel / 2) / kDoubledVoxel);
  }
  return weights;
}

}  // namespace footwall::extract
