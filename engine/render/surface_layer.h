// Parts of pictures as bytes, to be sent and kept: only the pixels that show something, in runs, inside the
// rectangle that holds them.
//
// Bytes of a part: int32 x0, y0, x1, y1 of the rectangle, half-open (all 0: nothing is seen); then, for each
// of its rows, uint32 number of runs; int32 first, uint32 count of each; then the pixels of all runs of the
// row: 8 bytes Visible each or 4 bytes depth each, and after those 4 bytes RGBA each. In the machine's order.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/render/colour.h"
#include "engine/render/visibility.h"

namespace footwall::render {

enum class PixelKind : std::uint8_t {
  kVisible,  // to be merged with other parts
  kDepth     // finished
};

// Appends the window's rows [begin, end), numbered as in the whole picture; colours: one per pixel of the
// window. What is background is left out. Returns how many pixels were taken.
std::size_t encode_pixels(const VisibilityBuffer& window, std::span<const Rgba> colours, int begin, int end,
                          PixelKind kind, std::vector<std::byte>& to);

// Keeps the nearer of each pixel, with its colour. part: of kVisible. Throws Error kCorrupt for bytes that
// are no such part, or whose rectangle does not lie in the window.
void merge_pixels(std::span<const std::byte> part, VisibilityBuffer& window, std::span<Rgba> colours);

// A finished picture of surfaces alone, to be laid into another one.
class SurfaceLayer {
 public:
  SurfaceLayer() = default;
  SurfaceLayer(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // Rows that are not there yet; part: of kDepth. Throws Error kCorrupt for bytes that are no such part of
  // this picture.
  void add(std::vector<std::byte> part);
  // depths 1 and colours 0 where nothing is seen; both have the picture's width.
  void row(int y, std::span<float> depths, std::span<Rgba> colours) const;
  // Of all parts.
  std::size_t bytes() const;

  // Throw Error kIo; kNotFound, kCorrupt.
  void write(const std::filesystem::path& path) const;
  static SurfaceLayer read(const std::filesystem::path& path);

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::vector<std::byte>> parts_;
  // Where each row stands: its part's number and the offset in it; part -1: shows nothing.
  struct Place {
    std::int32_t part = -1;
    std::size_t offset = 0;
  };
  std::vector<Place> rows_;
};

}  // namespace footwall::render
