// Flat drawing on finished pixels: filled shapes with smooth edges, for labels, panels and the north arrow.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/colour.h"

namespace footwall::render {

struct Point {
  double x = 0;  // pixels to the right; pixel (0, 0) has its centre at (0.5, 0.5)
  double y = 0;  // pixels downwards
};

class Canvas {
 public:
  // rgba: 4 * width * height bytes, row 0 on top; must outlive the canvas. Whatever lies outside is cut off.
  Canvas(int width, int height, std::span<std::uint8_t> rgba);

  int width() const { return width_; }
  int height() const { return height_; }
  // coverage 0..1, times the colour's alpha.
  void blend(int x, int y, Rgba colour, double coverage);
  // Even-odd.
  void fill_polygon(std::span<const Point> corners, Rgba colour);
  void fill_rectangle(double x0, double y0, double x1, double y1, Rgba colour);
  void fill_rounded(double x0, double y0, double x1, double y1, double radius, Rgba colour);
  void stroke(Point from, Point to, double width, Rgba colour);

 private:
  int width_;
  int height_;
  std::span<std::uint8_t> rgba_;
};

}  // namespace footwall::render
