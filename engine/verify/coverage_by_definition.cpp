#include "engine/verify/coverage_by_definition.h"

namespace footwall::verify {

int side_of_edge(const RasterPoint& a, const RasterPoint& b, std::int64_t x, std::int64_t y,
                 std::int64_t parts) {
  const std::int64_t dx = b.x - a.x;
  const std::int64_t dy = b.y - a.y;
  const std::int64_t terms[] = {dx * (y * parts + parts / 2 - a.y) - dy * (x * parts + parts / 2 - a.x), -dy,
                                dx};
  for (const std::int64_t term : terms) {
    if (term != 0) return term > 0 ? 1 : -1;
  }
  return 0;
}

bool covers(const RasterPoint& a, const RasterPoint& b, const RasterPoint& c, std::int64_t x, std::int64_t y,
            std::int64_t parts) {
  const int side = side_of_edge(a, b, x, y, parts);
  return side != 0 && side == side_of_edge(b, c, x, y, parts) && side == side_of_edge(c, a, x, y, parts);
}

}  // namespace footwall::verify
