// Which pixels of a picture are covered: a bit each, in tiles of 8 x 8 pixels that are one word each; above
// them tiles of 8 x 8 tiles, whose bits tell which of those are full, and so on up to one word. Whether a
// rectangle is covered is answered without looking below what is full.
// Based on: seed 003, sections 3.2 and 3.4.1, after Greene, Hierarchical polygon tiling with coverage masks,
// 1996; differs in that a bit is set by the rasterizer's own rule (rasterizer.h), exactly where a pixel would
// be drawn, instead of by a table of edges through tiles.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/rasterizer.h"

namespace footwall::render {

// Half-open; row 0 is on top.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

class CoverageMask {
 public:
  // Nothing is covered. Throws Error kUsage unless 1 <= width, height <= VisibilityBuffer::kLargest.
  CoverageMask(int width, int height);
  static constexpr int kTile = 8;

  int width() const { return width_; }
  int height() const { return height_; }
  void clear();
  bool covered(int x, int y) const {
    return (tile_at(x / kTile, y / kTile) >> static_cast<unsigned>(y % kTile * kTile + x % kTile) & 1U) != 0;
  }
  // What of the rectangle lies inside the picture; true where nothing does.
  bool covers(const PixelRect& rect) const;
  void fill(const PixelRect& rect);
  std::int64_t uncovered() const;  // pixels

  int tile_rows() const { return levels_.front().rows; }
  int tile_columns() const { return levels_.front().columns; }
  // The words of rows of tiles [first, last): bit 8 * (y % 8) + x % 8 of [y / 8][x / 8]. Bits beyond the
  // picture's borders are set.
  std::span<const std::uint64_t> tiles(int first, int last) const;
  // Covers what other words of such rows cover. Throws kInternal where their number is another.
  void merge(int first, std::span<const std::uint64_t> words);

  // For those who draw into it: the bits of a rectangle that lies in one tile, not empty; a tile's word; bits
  // that are to be set in a tile.
  static constexpr std::uint64_t bits_in_tile(const PixelRect& pixels) {
    const unsigned x0 = static_cast<unsigned>(pixels.x0) % kTile;
    const unsigned y0 = static_cast<unsigned>(pixels.y0) % kTile;
    const auto columns = static_cast<unsigned>(pixels.x1 - pixels.x0);
    const auto rows = static_cast<unsigned>(pixels.y1 - pixels.y0);
    const std::uint64_t row = ((std::uint64_t{1} << columns) - 1) << x0;
    return (0x0101010101010101U * row & ~std::uint64_t{0} >> (kTile * (kTile - rows))) << kTile * y0;
  }
  std::uint64_t tile_at(int column, int row) const {
    const Level& level = levels_.front();
    return level.words[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                       static_cast<std::size_t>(column)];
  }
  void add(int column, int row, std::uint64_t bits) {
    Level& level = levels_.front();
    std::uint64_t& word =
        level.words[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                    static_cast<std::size_t>(column)];
    if ((bits & ~word) == 0) return;
    word |= bits;
    if (word == ~std::uint64_t{0}) tell_full(column, row);
  }

 private:
  struct Level {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint64_t> words;
  };
  bool covers_within(std::size_t level, int column, int row, const PixelRect& pixels) const;
  void tell_full(int column, int row);

  int width_;
  int height_;
  std::vector<Level> levels_;  // from pixels to the one word on top
};

// Covers exactly the pixels that rasterize() would draw of these triangles, whether something is before them
// or not. `vertices` are the projected `positions` (rasterizer.h); indices must be inside. One thread.
void cover(const Matrix4& view_projection, std::span<const Vec3f> positions,
           std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
           CoverageMask& into);
// One triangle that needs no clipping.
void cover_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, CoverageMask& into);

}  // namespace footwall::render
