#include "engine/extract/face_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace footwall::extract {
namespace {

// The lowest 21 bits, two zeros behind each.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | (x << 32)) & 0x001f00000000ffffu;
  x = (x | (x << 16)) & 0x001f0000ff0000ffu;
  x = (x | (x << 8)) & 0x100f00f00f00f00fu;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3u;
  x = (x | (x << 2)) & 0x1249249249249249u;
  return x;
}

// Three times the centroid.
std::array<std::int64_t, 3> place_of(const Face& face) {
  std::array<std::int64_t, 3> sum{};
  for (const survey::LatticePoint& p : face.triangle) {
    sum[0] += p.i;
    sum[1] += p.j;
    sum[2] += p.k;
  }
  return sum;
}

}  // namespace

std::vector<std::int64_t> ordered_by_place(std::span<const Face> faces, std::span<const std::int64_t> which) {
  std::array<std::int64_t, 3> least;
  least.fill(std::numeric_limits<std::int64_t>::max());
  std::array<std::int64_t, 3> most;
  most.fill(std::numeric_limits<std::int64_t>::min());
  for (const std::int64_t n : which) {
    const auto place = place_of(faces[static_cast<std::size_t>(n)]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], place[axis]);
      most[axis] = std::max(most[axis], place[axis]);
    }
  }
  // One scale for all axes, so that the curve's cells are cubes.
  std::int64_t extent = 0;
  for (std::size_t axis = 0; axis < 3 && !which.empty(); ++axis)
    extent = std::max(extent, most[axis] - least[axis]);
  int shift = 0;
  while ((extent >> shift) >= (std::int64_t{1} << 21)) ++shift;

  std::vector<std::pair<std::uint64_t, std::int64_t>> keys;
  keys.reserve(which.size());
  for (const std::int64_t n : which) {
    const auto place = place_of(faces[static_cast<std::size_t>(n)]);
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::uint64_t>((place[axis] - least[axis]) >> shift);
      key |= spread(cell) << (2 - axis);
    }
    keys.emplace_back(key, n);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int64_t> order;
  order.reserve(keys.size());
  for (const auto& [key, n] : keys) order.push_back(n);
  return order;
}

std::vector<std::int64_t> ordered_by_place(std::span<const Face> faces) {
  std::vector<std::int64_t> all(faces.size());
  std::iota(all.begin(), all.end(), std::int64_t{0});
  return ordered_by_place(faces, all);
}

}  // namespace footwall::extract
