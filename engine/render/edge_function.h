// Which pixels a triangle covers, decided on whole numbers: the one rule that everything drawn follows, so
// that a coverage mask has the very pixels that a picture has, and that triangles with a common edge leave
// no gap and share no pixel. Positions are those of ScreenVertex.
#pragma once
#include <algorithm>
#include <cstdint>

#include "engine/render/rasterizer.h"

namespace footwall::render {

inline constexpr std::int32_t kHalfPixel = kSubPixels / 2;

// The first and last pixel whose centre lies in a closed interval of sub-pixels.
constexpr std::int32_t first_pixel(std::int32_t at) {
  return (at + kHalfPixel - 1) >> kSubPixelBits;
}
constexpr std::int32_t last_pixel(std::int32_t at) {
  return (at - kHalfPixel) >> kSubPixelBits;
}

// Twice the area of a, b, c: > 0 where they are clockwise as seen (y points downwards).
template <class Int>
constexpr Int twice_area(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return (Int{b.x} - a.x) * (Int{c.y} - a.y) - (Int{b.y} - a.y) * (Int{c.x} - a.x);
}

// An edge of a triangle whose corners are clockwise as seen: >= 0 at the centres of pixels inside. A centre
// on the edge itself belongs to the triangle for which it is a left or a top one; the bias takes the zero
// away from the other.
template <class Int>
struct EdgeFunction {
  Int at;     // at the centre of a first pixel, biased
  Int right;  // what a pixel further changes
  Int down;
  Int bias;

  // Of the edge from a to b; x, y: the first pixel.
  constexpr EdgeFunction(const ScreenVertex& a, const ScreenVertex& b, std::int32_t x, std::int32_t y) {
    const Int dx = Int{b.x} - a.x;
    const Int dy = Int{b.y} - a.y;
    bias = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
    at = dx * (Int{y} * kSubPixels + kHalfPixel - a.y) - dy * (Int{x} * kSubPixels + kHalfPixel - a.x) + bias;
    right = -dy * kSubPixels;
    down = dx * kSubPixels;
  }

  // Narrows [x0, x1], pixels counted from the first, to those inside the edge, so many rows further down.
  constexpr void narrow(Int rows_down, Int& x0, Int& x1) const {
    const Int at_row = at + down * rows_down;
    if (right > 0) {
      x0 = std::max(x0, -floor_divided(at_row, right));
    } else if (right < 0) {
      x1 = std::min(x1, floor_divided(at_row, -right));
    } else if (at_row < 0) {
      x1 = x0 - 1;
    }
  }

 private:
  static constexpr Int floor_divided(Int a, Int positive) {
    return a >= 0 ? a / positive : -((-a + positive - 1) / positive);
  }
};

}  // namespace footwall::render
