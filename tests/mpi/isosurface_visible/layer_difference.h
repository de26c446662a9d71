// A picture made on several ranks against that of the whole surface.
#pragma once
#include <string>
#include <vector>

#include "engine/render/surface_layer.h"
#include "engine/verify/visible_by_definition.h"

namespace footwall::isosurface {

// "" where the layer shows what the whole surface's picture shows.
inline std::string difference(const verify::SurfacePicture& whole, const render::SurfaceLayer& layer) {
  const auto width = static_cast<std::size_t>(whole.width);
  std::vector<float> depths(width);
  std::vector<render::Rgba> colours(width);
  for (int y = 0; y < whole.height; ++y) {
    layer.row(y, depths, colours);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x) {
      if (depths[x] != whole.depths[first + x] || colours[x] != whole.colours[first + x])
        return "pixel " + std::to_string(x) + ", " + std::to_string(y);
    }
  }
  return "";
}

}  // namespace footwall::isosurface
