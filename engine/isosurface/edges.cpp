#include "engine/isosurface/edges.h"

#include <algorithm>

namespace footwall::isosurface::detail {

EdgeEnds edge_ends_of(const Surface& surface) {
  EdgeEnds sorted;
  sorted.first.assign(surface.positions.size() + 1, 0);
  for (const Triangle& triangle : surface.triangles.all()) {
    for (std::size_t n = 0; n < 3; ++n) ++sorted.first[std::min(triangle[n], triangle[(n + 1) % 3]) + 1];
  }
  for (std::size_t a = 1; a < sorted.first.size(); ++a) sorted.first[a] += sorted.first[a - 1];
  sorted.ends.resize(sorted.first.back());
  std::vector<std::uint64_t> next(sorted.first.begin(), sorted.first.end() - 1);
  for (const Triangle& triangle : surface.triangles.all()) {
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t from = triangle[n], to = triangle[(n + 1) % 3];
      sorted.ends[next[std::min(from, to)]++] = std::uint64_t{2} * std::max(from, to) + (from > to ? 1 : 0);
    }
  }
  for (std::size_t a = 0; a + 1 < sorted.first.size(); ++a) {
    std::sort(sorted.ends.begin() + static_cast<std::ptrdiff_t>(sorted.first[a]),
              sorted.ends.begin() + static_cast<std::ptrdiff_t>(sorted.first[a + 1]));
  }
  return sorted;
}

}  // namespace footwall::isosurface::detail
