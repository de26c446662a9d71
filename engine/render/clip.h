// Triangles that reach behind the eye, or beyond what fixed point holds, cut to what can be drawn.
#pragma once
#include <array>

#include "engine/render/rasterizer.h"

namespace footwall::render {

// The triangles 0, n - 1, n of the corners, for n = 2 .. count - 1. None where count < 3.
struct ClippedFan {
  static constexpr int kMostCorners = 9;  // each of the six planes adds one at most
  std::array<ScreenVertex, kMostCorners> corners;
  int count = 0;
};

// Of a triangle in clip space, for a picture of width x height pixels. Along an edge that two triangles
// share, both are cut at the same bits.
ClippedFan clipped_fan(const Vec4& a, const Vec4& b, const Vec4& c, int width, int height);

}  // namespace footwall::render
