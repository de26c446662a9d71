// The light of a lit surface's pixels, many at once.
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "engine/render/colour.h"

namespace footwall::render {

// Pixels of one surface, what is needed of each in an array of its own: the normals at the three corners of
// its triangle, the corners' weights (of any sum that is not 0), and 1 where the side that normals point to
// is seen, else -1.
struct LitPixels {
  static constexpr std::size_t kRoom = 64;
  alignas(64) float x[3][kRoom];
  alignas(64) float y[3][kRoom];
  alignas(64) float z[3][kRoom];
  alignas(64) float weight[3][kRoom];
  alignas(64) float side[kRoom];
  std::size_t count = 0;
};

// The colours of all pixels: the brightness of each corner, interpolated by the weights. to_view: see
// normals_to_view() (lit_surface.h). `to` has room for kRoom; what lies behind the last pixel is overwritten,
// too.
void light_pixels(const std::array<float, 9>& to_view, Rgba colour, const LitPixels& pixels,
                  std::span<Rgba, LitPixels::kRoom> to);

}  // namespace footwall::render
