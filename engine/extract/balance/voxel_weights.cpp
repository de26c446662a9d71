#include "engine/extract/balance/voxel_weights.h"

#include <algorithm>
#include <optional>

#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

using Corner = std::array<std::int64_t, 3>;

Corner corner(const survey::LatticePoint& p) {
  return {p.i, p.j, p.k};
}

}  // namespace

std::vector<std::int64_t> voxel_weights(std::span<const Face> faces, const survey::Index& dims) {
  std::vector<std::int64_t> weights(faces.size());
  voxel_weights(faces, dims, weights);
  return weights;
}

void voxel_weights(std::span<const Face> faces, const survey::Index& dims, std::span<std::int64_t> weights) {
  constexpr std::int64_t kVoxel = survey::kLatticePerVoxel;
  require(weights.size() == faces.size(), "a weight for every face");
  std::optional<voxelize::ExactScratch> scratch;
  const survey::Box survey{{0, 0, 0}, dims};
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Face& face = faces[n];
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
      if (!scratch) scratch.emplace();
      weights[n] = voxelize::count(face.triangle, survey, *scratch);
      continue;
    }
    std::int64_t doubled = 0;  // twice A (|nx| + |ny| + |nz|), in lattice units
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = (c + 1) % 3;
      const std::size_t b = (c + 2) % 3;
      const std::int64_t part =
          (at[1][a] - at[0][a]) * (at[2][b] - at[0][b]) - (at[1][b] - at[0][b]) * (at[2][a] - at[0][a]);
      doubled += part < 0 ? -part : part;
    }
    // Cubes are closed and vertices on the lattice, so that a cube counts as 257 lattice steps wide.
    constexpr std::int64_t kCube = kVoxel + 1;
    constexpr std::int64_t kDoubledVoxel = 2 * kVoxel * kVoxel;
    const std::int64_t sum =
        doubled + doubled / kVoxel + 2 * kCube * kCube * sides / kVoxel + 2 * kCube * kCube * kCube / kVoxel;
    weights[n] = (sum + kDoubledVoxel / 2) / kDoubledVoxel;
  }
}

}  // namespace footwall::extract
