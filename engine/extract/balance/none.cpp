#include "engine/extract/balance/none.h"

#include <algorithm>

namespace footwall::extract {
namespace {

// sum / (3 * 256) to the nearest integer, ties to even.
std::int64_t rounded_third(std::int64_t sum) {
  constexpr std::int64_t kDivisor = 3 * survey::kLatticePerVoxel;
  std::int64_t quotient = sum / kDivisor;
  std::int64_t rest = sum % kDivisor;
  if (rest < 0) {
    rest += kDivisor;
    --quotient;
  }
  if (2 * rest > kDivisor || (2 * rest == kDivisor && quotient % 2 != 0)) ++quotient;
  return quotient;
}

}  // namespace

survey::Index centroid_voxel(const survey::LatticeTriangle& t, const survey::Index& dims) {
  const survey::Index sums{std::int64_t{t[0].i} + t[1].i + t[2].i, std::int64_t{t[0].j} + t[1].j + t[2].j,
                           std::int64_t{t[0].k} + t[1].k + t[2].k};
  survey::Index voxel{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    voxel[axis] = std::clamp<std::int64_t>(rounded_third(sums[axis]), 0, dims[axis] - 1);
  }
  return voxel;
}

std::vector<int> balance_none(const BalanceInput& input) {
  const comm::RankGrid& grid = input.grid;
  std::vector<int> ranks(input.faces.size());
  std::transform(input.faces.begin(), input.faces.end(), ranks.begin(),
                 [&](const Face& face) { return grid.owner(centroid_voxel(face.triangle, grid.dims())); });
  return ranks;
}

void check_none(const Choice& choice) {
  choice.takes_at_most(0);
}

}  // namespace footwall::extract
