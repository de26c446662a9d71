// How far away a picture's pixels are at most, in 16 bits a pixel, with the greatest of 2 x 2, 4 x 4, ... of
// them: what lies behind all of a rectangle is found by looking at a few numbers.
//
// Everything is rounded to the safe side: what is hidden by the pyramid is hidden in the picture, bit for
// bit. Depths of surfaces are rounded away from the eye, those of boxes towards it, and boxes are given more
// room than any rounding of vertices takes. Minima of rounded depths are the rounded minima: pyramids that
// several ranks filled are merged by the least of each pixel, whatever rank drew what.
// Based on: algorithms section 4; Greene, Kass and Miller, Hierarchical Z-buffer visibility, 1993.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/visibility.h"

namespace footwall::render {

using CoarseDepth = std::uint16_t;
// Nothing is seen here: hides nothing.
inline constexpr CoarseDepth kOpenPixel = 0xffff;

// Window depths between two limits in 65535 steps.
struct DepthScale {
  // Beyond them depths are held: nearer ones at the first step, farther ones hide nothing.
  static DepthScale between(double nearest, double farthest);

  // Of something whose depth may come out a little less than it was computed.
  CoarseDepth of_box(double depth) const {
    const double step = (depth - kSlack - least) * steps - 0.0625;
    return static_cast<CoarseDepth>(step > 0 ? (step < kOpenPixel - 1 ? step : kOpenPixel - 1) : 0);
  }
  // The far side of something.
  CoarseDepth behind(double depth) const {
    const double step = (depth + kSlack - least) * steps + 1;
    return static_cast<CoarseDepth>(step > 0 ? (step < kOpenPixel - 1 ? step : kOpenPixel - 1) : 0);
  }

  // What float32 depths and the rasterizer's interpolation may be off by.
  static constexpr double kSlack = 1.0 / (1 << 20);
  double least = 0;
  double steps = 65533;
};

// Pixels and depths that something takes in: x0 <= x <= x1, none where x0 > x1 or y0 > y1.
struct ScreenBox {
  std::int16_t x0 = 0;
  std::int16_t y0 = 0;
  std::int16_t x1 = -1;
  std::int16_t y1 = -1;
  CoarseDepth nearest = 0;
  CoarseDepth farthest = 0;
  bool empty() const { return x0 > x1 || y0 > y1; }
  friend bool operator==(const ScreenBox&, const ScreenBox&) = default;
};

class DepthPyramid {
 public:
  // Of the pixels of `window` (its depths are of no interest) of a picture; all are open. Boxes are cut at
  // the window; what of them lies outside is taken for hidden.
  explicit DepthPyramid(const ScreenBox& window);
  DepthPyramid() : DepthPyramid(ScreenBox{}) {}

  const ScreenBox& window() const { return window_; }
  int width() const { return width_; }
  int height() const { return height_; }
  // Row by row, row_step() apart; those behind a row's end are nobody's, but may be merged like others.
  std::span<CoarseDepth> pixels() { return std::span(pixels_).first(levels_.front().first_beyond); }
  std::span<const CoarseDepth> pixels() const {
    return std::span(pixels_).first(levels_.front().first_beyond);
  }
  std::size_t row_step() const { return levels_.front().step; }
  std::span<const CoarseDepth> row(int y) const {
    return pixels().subspan(static_cast<std::size_t>(y - window_.y0) * row_step(),
                            static_cast<std::size_t>(width_));
  }

  // After any of these the pyramid is not to be asked before build().
  void open();
  void assign(const VisibilityBuffer& picture, const DepthScale& scale);  // the picture holds the window
  void assign(const DepthPyramid& other);                                 // of the same window
  void assign_open(const DepthPyramid& other);  // open where the other is, hidden everywhere else
  // Keeps the nearer of each pixel of the box.
  void cover(const ScreenBox& box, CoarseDepth depth);
  void build();

  // Whether all of the box lies behind what is seen at its pixels.
  bool hides(const ScreenBox& box) const;
  // The greatest of a block of 2^level x 2^level pixels, one of which is (x, y), a pixel of the window. Of
  // levels that there are not: the last one's.
  CoarseDepth farthest_around(int x, int y, std::size_t level) const {
    const std::size_t n = level < levels_.size() ? level : levels_.size() - 1;
    return pixels_[levels_[n].first + static_cast<std::size_t>((y - window_.y0) >> n) * levels_[n].step +
                   static_cast<std::size_t>((x - window_.x0) >> n)];
  }
  // Whether no pixel of the box is open.
  bool is_closed(const ScreenBox& box) const;
  // Sets a bit for each pixel that is open in `other`, of the same window, but not here: of the word
  // row * words_a_row() + x / 64 from the window's corner on.
  void mark_closed(const DepthPyramid& other, std::span<std::uint64_t> bits) const;
  std::size_t words_a_row() const { return static_cast<std::size_t>(width_ + 63) / 64; }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::size_t first = 0;  // of pixels_
    std::size_t step = 0;   // from row to row
    std::size_t first_beyond = 0;
  };
  ScreenBox window_;
  int width_ = 0;
  int height_ = 0;
  std::vector<Level> levels_;
  std::vector<CoarseDepth> pixels_;  // with room to read beyond
};

}  // namespace footwall::render
