#include "engine/extract/balance/area.h"

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

__extension__ typedef __int128 Int128;

constexpr FixedArea kLargest = FixedArea{1} << 61;

// The largest whole number whose square is not above `square` (0 <= square < 2^126). The estimate may be off
// by what floating point pleases: it is mended until it is exact.
std::int64_t whole_root(Int128 square) {
  auto root = static_cast<Int128>(std::sqrt(static_cast<double>(square)));
  constexpr Int128 kNarrow = Int128{1} << 52;
  if (square >= kNarrow) root = (root + square / root) / 2;
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return static_cast<std::int64_t>(root);
}

std::int64_t whole_root_64(std::int64_t square) {
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return root;
}

}  // namespace

FixedArea fixed_area(const survey::LatticeTriangle& t) {
  const auto edge = [&](std::size_t to) {
    return std::array<std::int64_t, 3>{std::int64_t{t[to].i} - t[0].i, std::int64_t{t[to].j} - t[0].j,
                                       std::int64_t{t[to].k} - t[0].k};
  };
  const auto p = edge(1);
  const auto q = edge(2);
  std::array<Int128, 3> normal{};  // its length is twice the area
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t a = (n + 1) % 3;
    const std::size_t b = (n + 2) % 3;
    normal[n] = static_cast<Int128>(p[a]) * q[b] - static_cast<Int128>(p[b]) * q[a];
    if (normal[n] < 0) normal[n] = -normal[n];
  }
  const Int128 longest = std::max({normal[0], normal[1], normal[2]});
  if (longest >= 2 * static_cast<Int128>(kLargest)) return kLargest;
  const Int128 square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  constexpr Int128 kFew = Int128{1} << 61;
  if (square < kFew) return whole_root_64(static_cast<std::int64_t>(square / 4));
  return std::min(kLargest, whole_root(square / 4));
}

std::vector<FixedArea> fixed_areas(std::span<const Face> faces) {
  std::vector<FixedArea> areas(faces.size());
  if (faces.empty()) return areas;
  const FixedArea most = kLargest / static_cast<FixedArea>(faces.size());
  std::transform(faces.begin(), faces.end(), areas.begin(),
                 [&](const Face& face) { return std::min(most, fixed_area(face.triangle)); });
  return areas;
}

double load_deviation(std::span<const FixedArea> loads) {
  if (loads.size() < 2) return 0;
  double total = 0;
  for (const FixedArea load : loads) total += voxel2(load);
  const double mean = total / static_cast<double>(loads.size());
  double squares = 0;
  for (const FixedArea load : loads) squares += (voxel2(load) - mean) * (voxel2(load) - mean);
  return std::sqrt(squares / static_cast<double>(loads.size() - 1));
}

std::vector<FixedArea> loads_of(std::span<const FixedArea> areas, std::span<const int> responsible,
                                int ranks) {
  require(areas.size() == responsible.size(), "a rank for every face");
  std::vector<FixedArea> loads(static_cast<std::size_t>(ranks), 0);
  for (std::size_t n = 0; n < areas.size(); ++n)
    loads.at(static_cast<std::size_t>(responsible[n])) += areas[n];
  return loads;
}

}  // namespace footwall::extract
