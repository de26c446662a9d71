// The definition of coverage, slowly: a pixel belongs to a triangle if its centre, moved to the right by
// something infinitely small and down by something infinitely smaller, lies strictly inside. That is the
// top-left rule said without edges, so that it shares no thought with the rasterizer.
#pragma once
#include <cstdint>

#include "engine/render/rasterizer.h"

namespace footwall::render::reference {

// -1, 0, 1: on which side of a -> b the moved centre of pixel (x, y) lies; 0 only for a == b.
inline int side(const ScreenVertex& a, const ScreenVertex& b, std::int64_t x, std::int64_t y) {
  const std::int64_t dx = std::int64_t{b.x} - a.x;
  const std::int64_t dy = std::int64_t{b.y} - a.y;
  const std::int64_t terms[] = {
      dx * (y * kSubPixels + kSubPixels / 2 - a.y) - dy * (x * kSubPixels + kSubPixels / 2 - a.x), -dy, dx};
  for (const std::int64_t term : terms) {
    if (term != 0) return term > 0 ? 1 : -1;
  }
  return 0;
}

inline bool covers(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::int64_t x,
                   std::int64_t y) {
  const int s = side(a, b, x, y);
  return s != 0 && s == side(b, c, x, y) && s == side(c, a, x, y);
}

}  // namespace footwall::render::reference
