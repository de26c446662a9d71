// The definition of coverage, slowly: a pixel belongs to a triangle if its centre, moved to the right by
// something infinitely small and down by something infinitely smaller, lies strictly inside. That is the
// top-left rule said without edges, so that it shares no thought with the rasterizer.
#pragma once
#include <cstdint>

namespace footwall::verify {

// A corner in whole parts of a pixel, to the right and downwards.
struct RasterPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

// -1, 0, 1: on which side of a -> b the moved centre of pixel (x, y) lies; 0 only for a == b. `parts` of a
// pixel's width, an even number; everything below 2^30.
int side_of_edge(const RasterPoint& a, const RasterPoint& b, std::int64_t x, std::int64_t y,
                 std::int64_t parts);
// Whichever way round the corners are.
bool covers(const RasterPoint& a, const RasterPoint& b, const RasterPoint& c, std::int64_t x, std::int64_t y,
            std::int64_t parts);

}  // namespace footwall::verify
