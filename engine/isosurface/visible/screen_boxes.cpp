#include "engine/isosurface/visible/screen_boxes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace footwall::isosurface {
namespace {

// Vertices are rounded to 1/256 pixel; float32 holds places in the largest picture to 1/512.
constexpr float kMargin = 1.0F / 64;
constexpr int kPoints = 5;  // of a brick, along an axis
constexpr int kStep = 2;

// A number for each point (a, b, c), and what is found among the 2 x 2 x 2 around a part.
using Grid = std::array<std::array<std::array<float, 8>, kPoints>, kPoints>;

struct Points {
  Grid x;
  Grid y;
  Grid depth;
  bool is_clipped = false;  // some lie before the near plane
};

Points project(const render::Matrix4& m, const survey::Box& cells, int width, int height) {
  Points points;
  double least_w = INFINITY;
  double least_before = INFINITY;
  const double w_to_pixels = 0.5 * width;
  const double h_to_pixels = 0.5 * height;
  for (int a = 0; a < kPoints; ++a) {
    const auto i = static_cast<double>(std::min(cells.lo[0] + kStep * a, cells.hi[0]));
    for (int b = 0; b < kPoints; ++b) {
      const auto j = static_cast<double>(std::min(cells.lo[1] + kStep * b, cells.hi[1]));
      std::array<double, 4> row{};
      for (std::size_t n = 0; n < 4; ++n) row[n] = m[4 * n] * i + m[4 * n + 1] * j + m[4 * n + 3];
      for (int c = 0; c < 8; ++c) {
        const auto k = static_cast<double>(std::min(cells.lo[2] + kStep * std::min(c, 4), cells.hi[2]));
        const double x = row[0] + m[2] * k;
        const double y = row[1] + m[6] * k;
        const double z = row[2] + m[10] * k;
        const double w = row[3] + m[14] * k;
        least_w = std::min(least_w, w);
        least_before = std::min(least_before, w + z);
        const double inverse = 1 / w;
        points.x[a][b][c] = static_cast<float>((x * inverse + 1) * w_to_pixels);
        points.y[a][b][c] = static_cast<float>((1 - y * inverse) * h_to_pixels);
        points.depth[a][b][c] = static_cast<float>((z * inverse + 1) * 0.5);
      }
    }
  }
  points.is_clipped = !(least_w > 0) || !(least_before > 0) || !std::isfinite(least_w);
  return points;
}

// Of the points at both ends of each part, along all three axes.
template <class Better>
void fold(Grid& grid, Better&& better) {
  for (auto& plane : grid) {
    for (auto& row : plane) {
      for (std::size_t c = 0; c < 4; ++c) row[c] = better(row[c], row[c + 1]);
    }
    for (std::size_t b = 0; b < 4; ++b) {
      for (std::size_t c = 0; c < 4; ++c) plane[b][c] = better(plane[b][c], plane[b + 1][c]);
    }
  }
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      for (std::size_t c = 0; c < 4; ++c) grid[a][b][c] = better(grid[a][b][c], grid[a + 1][b][c]);
    }
  }
}

float lesser(float a, float b) {
  return a < b ? a : b;
}
float greater(float a, float b) {
  return a > b ? a : b;
}

// The first and last pixel whose centre may be met, held where an int can tell it.
int first_pixel(float least, int size) {
  return static_cast<int>(std::ceil(std::clamp(least - kMargin, -1.0F, static_cast<float>(size) + 1) - 0.5F));
}
int last_pixel(float greatest, int size) {
  return static_cast<int>(
      std::floor(std::clamp(greatest + kMargin, -1.0F, static_cast<float>(size) + 1) - 0.5F));
}

std::int16_t held(int pixel, int size) {
  return static_cast<std::int16_t>(std::clamp(pixel, 0, size - 1));
}

}  // namespace

ScreenBoxes::ScreenBoxes(const render::Camera& camera, const render::Placement& placement, int width,
                         int height)
    : to_clip_(placement.then(camera.view_projection)), width_(width), height_(height) {}

LooseBox ScreenBoxes::of(const survey::Box& cells) const {
  LooseBox box{0, 0, width_ - 1, height_ - 1, 0, 1};
  double least[3] = {INFINITY, INFINITY, INFINITY};
  double most[3] = {-INFINITY, -INFINITY, -INFINITY};
  bool is_clipped = false;
  bool all_before = true;
  for (unsigned corner = 0; corner < 8; ++corner) {
    survey::Vector3 p;
    p.x = static_cast<double>((corner & 1U) != 0 ? cells.hi[0] : cells.lo[0]);
    p.y = static_cast<double>((corner & 2U) != 0 ? cells.hi[1] : cells.lo[1]);
    p.z = static_cast<double>((corner & 4U) != 0 ? cells.hi[2] : cells.lo[2]);
    const render::Vec4 clip = render::transformed(to_clip_, p);
    const bool is_before = clip.w + clip.z < 0;
    is_clipped = is_clipped || !(clip.w > 0) || !(clip.w + clip.z > 0);
    all_before = all_before && is_before;
    const double at[3] = {(clip.x / clip.w + 1) * 0.5 * width_, (1 - clip.y / clip.w) * 0.5 * height_,
                          (clip.z / clip.w + 1) * 0.5};
    for (int n = 0; n < 3; ++n) {
      least[n] = std::min(least[n], at[n]);
      most[n] = std::max(most[n], at[n]);
    }
  }
  if (all_before) return {};
  if (is_clipped) return box;
  if (least[2] > 1 + render::DepthScale::kSlack) return {};  // behind the far plane
  box.x0 = std::max(0, first_pixel(static_cast<float>(least[0]), width_));
  box.x1 = std::min(width_ - 1, last_pixel(static_cast<float>(most[0]), width_));
  box.y0 = std::max(0, first_pixel(static_cast<float>(least[1]), height_));
  box.y1 = std::min(height_ - 1, last_pixel(static_cast<float>(most[1]), height_));
  box.nearest = least[2];
  box.farthest = most[2];
  return box;
}

render::ScreenBox ScreenBoxes::scaled(const LooseBox& box, const render::DepthScale& scale) const {
  if (box.empty()) return {};
  return {held(box.x0, width_),  held(box.y0, height_),     held(box.x1, width_),
          held(box.y1, height_), scale.of_box(box.nearest), scale.behind(box.farthest)};
}

BrickParts ScreenBoxes::of_parts(const survey::Box& cells, BrickParts parts, const render::DepthScale& scale,
                                 render::ScreenBox* into) const {
  BrickParts kept = 0;
  Points points = project(to_clip_, cells, width_, height_);
  if (points.is_clipped) {
    for (BrickParts left = parts; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const survey::Index from{cells.lo[0] + kStep * (bit >> 4), cells.lo[1] + kStep * (bit >> 2 & 3),
                               cells.lo[2] + kStep * (bit & 3)};
      const survey::Box part =
          survey::intersection({from, {from[0] + kStep, from[1] + kStep, from[2] + kStep}}, cells);
      const LooseBox box = of(part);
      if (box.empty()) continue;
      *into++ = scaled(box, scale);
      kept |= BrickParts{1} << static_cast<unsigned>(bit);
    }
    return kept;
  }
  Grid x1 = points.x;
  Grid y1 = points.y;
  Grid farthest = points.depth;
  fold(points.x, lesser);
  fold(points.y, lesser);
  fold(points.depth, lesser);
  fold(x1, greater);
  fold(y1, greater);
  fold(farthest, greater);
  for (BrickParts left = parts; left != 0; left &= left - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(left));
    const std::size_t a = bit >> 4;
    const std::size_t b = bit >> 2 & 3;
    const std::size_t c = bit & 3;
    const LooseBox box{std::max(0, first_pixel(points.x[a][b][c], width_)),
                       std::max(0, first_pixel(points.y[a][b][c], height_)),
                       std::min(width_ - 1, last_pixel(x1[a][b][c], width_)),
                       std::min(height_ - 1, last_pixel(y1[a][b][c], height_)),
                       points.depth[a][b][c],
                       farthest[a][b][c]};
    if (box.empty() || box.nearest > 1 + render::DepthScale::kSlack) continue;
    *into++ = scaled(box, scale);
    kept |= BrickParts{1} << bit;
  }
  return kept;
}

}  // namespace footwall::isosurface
