#include "engine/render/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kRowsPerPixel = 4;  // scan lines per pixel; along a scan line coverage is exact

}  // namespace

Canvas::Canvas(int width, int height, std::span<std::uint8_t> rgba)
    : width_(width), height_(height), rgba_(rgba) {
  require(width > 0 && height > 0 &&
              rgba.size() == 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "a canvas has four bytes per pixel");
}

void Canvas::blend(int x, int y, Rgba colour, double coverage) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const double share = std::clamp(coverage, 0.0, 1.0) * alpha(colour) / 255;
  std::uint8_t* p = &rgba_[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(x))];
  const unsigned channels[3] = {red(colour), green(colour), blue(colour)};
  for (int c = 0; c < 3; ++c)
    p[c] = static_cast<std::uint8_t>(p[c] + (channels[c] - static_cast<double>(p[c])) * share + 0.5);
}

void Canvas::fill_polygon(std::span<const Point> corners, Rgba colour) {
  if (corners.size() < 3) return;
  double top = corners[0].y;
  double bottom = corners[0].y;
  for (const Point& p : corners) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  const int first = static_cast<int>(std::floor(std::clamp(top, 0.0, static_cast<double>(height_))));
  const int last = static_cast<int>(std::ceil(std::clamp(bottom, 0.0, static_cast<double>(height_))));
  std::vector<double> crossings;
  std::vector<double> coverage(static_cast<std::size_t>(width_));
  for (int y = first; y < last; ++y) {
    int from = width_;
    int to = 0;
    for (int line = 0; line < kRowsPerPixel; ++line) {
      const double at = y + (line + 0.5) / kRowsPerPixel;
      crossings.clear();
      for (std::size_t n = 0; n < corners.size(); ++n) {
        const Point& a = corners[n];
        const Point& b = corners[(n + 1) % corners.size()];
        if ((a.y <= at) != (b.y <= at)) crossings.push_back(a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
        const double x0 = std::clamp(crossings[n], 0.0, static_cast<double>(width_));
        const double x1 = std::clamp(crossings[n + 1], 0.0, static_cast<double>(width_));
        for (int x = static_cast<int>(x0); x < width_ && x < x1; ++x) {
          coverage[static_cast<std::size_t>(x)] +=
              std::max(0.0, std::min(x1, x + 1.0) - std::max<double>(x0, x)) / kRowsPerPixel;
          from = std::min(from, x);
          to = std::max(to, x + 1);
        }
      }
    }
    for (int x = from; x < to; ++x) {
      blend(x, y, colour, coverage[static_cast<std::size_t>(x)]);
      coverage[static_cast<std::size_t>(x)] = 0;
    }
  }
}

void Canvas::fill_rectangle(double x0, double y0, double x1, double y1, Rgba colour) {
  const Point corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  fill_polygon(corners, colour);
}

void Canvas::fill_rounded(double x0, double y0, double x1, double y1, double radius, Rgba colour) {
  constexpr int kSteps = 8;  // per corner
  std::vector<Point> corners;
  const Point middles[] = {{x1 - radius, y1 - radius},
                           {x0 + radius, y1 - radius},
                           {x0 + radius, y0 + radius},
                           {x1 - radius, y0 + radius}};
  for (int corner = 0; corner < 4; ++corner) {
    for (int step = 0; step <= kSteps; ++step) {
      const double angle = (corner + static_cast<double>(step) / kSteps) * std::numbers::pi / 2;
      corners.push_back(
          {middles[corner].x + radius * std::cos(angle), middles[corner].y + radius * std::sin(angle)});
    }
  }
  fill_polygon(corners, colour);
}

void Canvas::stroke(Point from, Point to, double width, Rgba colour) {
  const double far = std::hypot(to.x - from.x, to.y - from.y);
  if (!(far > 0)) return;
  const double sx = -(to.y - from.y) / far * width / 2;
  const double sy = (to.x - from.x) / far * width / 2;
  const Point corners[] = {
      {from.x + sx, from.y + sy}, {to.x + sx, to.y + sy}, {to.x - sx, to.y - sy}, {from.x - sx, from.y - sy}};
  fill_polygon(corners, colour);
}

}  // namespace footwall::render
