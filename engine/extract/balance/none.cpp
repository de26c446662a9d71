#include "engine/extract/balance/none.h"

#include <algorithm>

#include "engine/extract/balance/start.h"

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

// The rank coordinate of a line. In 32 bits, and without a second division where nothing is interleaved:
// divisions are most of what a decision costs.
std::uint32_t place_of(std::int64_t line, std::int64_t lines, int parts) {
  const std::uint32_t pillar = static_cast<std::uint32_t>(line) / static_cast<std::uint32_t>(lines);
  const auto along = static_cast<std::uint32_t>(parts);
  return pillar < along ? pillar : pillar % along;
}

}  // namespace

int centroid_rank(const survey::LatticeTriangle& t, const comm::RankGrid& grid) {
  const std::int64_t i =
      std::clamp<std::int64_t>(rounded_third(std::int64_t{t[0].i} + t[1].i + t[2].i), 0, grid.dims()[0] - 1);
  const std::int64_t j =
      std::clamp<std::int64_t>(rounded_third(std::int64_t{t[0].j} + t[1].j + t[2].j), 0, grid.dims()[1] - 1);
  const auto [rows, columns] = grid.parts();
  return static_cast<int>(place_of(i, grid.lines()[0], rows)) * columns +
         static_cast<int>(place_of(j, grid.lines()[1], columns));
}

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
  return starting_ranks(input);
}

void check_none(const Choice& choice) {
  choice.takes_at_most(0);
}

}  // namespace footwall::extract
