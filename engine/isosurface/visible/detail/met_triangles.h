// Triangles that can own a pixel: those that have a pixel's centre in their bounding box which no earlier
// wave hides from them.
#pragma once
#include <span>

#include "engine/isosurface/surface.h"
#include "engine/render/depth_pyramid.h"
#include "engine/render/rasterizer.h"

namespace footwall::isosurface::detail {

// Depths of earlier waves; null: there are none.
struct EarlierWaves {
  const render::DepthPyramid* depths = nullptr;
  render::DepthScale scale;
};

struct Screen {
  std::span<const render::ScreenVertex> vertices;
  int width = 0;
  int height = 0;
  EarlierWaves earlier;
};

// Moves the triangles [first, end) that are met to `to` and on, in their order; returns where they end.
// to <= first.
std::size_t keep_met(const Screen& screen, std::span<Triangle> triangles, std::size_t first, std::size_t end,
                     std::size_t to);

}  // namespace footwall::isosurface::detail
