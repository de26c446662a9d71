#include "engine/render/merge_layers.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::render {

SurfaceLayer nearer_of(const SurfaceLayer& first, const SurfaceLayer& second) {
  require(first.width() == second.width() && first.height() == second.height(), "layers of one size");
  // So many rows are whole at a time.
  constexpr int kRows = 64;
  const int width = first.width();
  const auto across = static_cast<std::size_t>(width);
  SurfaceLayer merged(width, first.height());
  std::vector<float> depths(across);
  std::vector<float> other_depths(across);
  std::vector<Rgba> other_colours(across);
  std::vector<Rgba> colours(across * kRows);
  for (int begin = 0; begin < first.height(); begin += kRows) {
    const int end = std::min(begin + kRows, first.height());
    VisibilityBuffer window(width, first.height(), begin, end - begin);
    window.clear();
    for (int y = begin; y < end; ++y) {
      const std::span<Rgba> shown =
          std::span(colours).subspan(static_cast<std::size_t>(y - begin) * across, across);
      first.row(y, depths, shown);
      second.row(y, other_depths, other_colours);
      const std::span<Visible> pixels = window.row(y);
      for (std::size_t x = 0; x < across; ++x) {
        // What shows nothing is transparent.
        if (other_colours[x] != 0 && (shown[x] == 0 || other_depths[x] < depths[x])) {
          shown[x] = other_colours[x];
          depths[x] = other_depths[x];
        }
        if (shown[x] != 0) pixels[x] = visible(depths[x], 0);
      }
    }
    std::vector<std::byte> part;
    encode_pixels(window, colours, begin, end, PixelKind::kDepth, part);
    merged.add(std::move(part));
  }
  return merged;
}

}  // namespace footwall::render
