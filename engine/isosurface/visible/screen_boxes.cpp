#include "engine/isosurface/visible/screen_boxes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/isosurface/visible/detail/part_boxes.h"

namespace footwall::isosurface {
namespace {

// Vertices are rounded to 1/256 pixel; float32 holds places in the largest picture to 1/512.
constexpr float kMargin = 1.0F / 64;
constexpr int kStep = 2;

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

BrickParts ScreenBoxes::of_parts(const survey::Box& cells, BrickParts parts, const render::ScreenBox& brick,
                                 const render::DepthScale& scale, render::ScreenBox* into) const {
  BrickParts kept = 0;
  const auto keep = [&](int bit, const render::ScreenBox& box) {
    *into++ = box;
    kept |= BrickParts{1} << static_cast<unsigned>(bit);
  };
  detail::PartBoxes found;
  if (detail::find_part_boxes(to_clip_, cells, {width_, height_}, scale, found)) {
    for (BrickParts left = parts; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const int x0 = std::max<int>(brick.x0, found.x0[bit]);
      const int y0 = std::max<int>(brick.y0, found.y0[bit]);
      const int x1 = std::min<int>(brick.x1, found.x1[bit]);
      const int y1 = std::min<int>(brick.y1, found.y1[bit]);
      if (x0 > x1 || y0 > y1) continue;
      keep(bit, {static_cast<std::int16_t>(x0), static_cast<std::int16_t>(y0), static_cast<std::int16_t>(x1),
                 static_cast<std::int16_t>(y1), static_cast<render::CoarseDepth>(found.nearest[bit]),
                 static_cast<render::CoarseDepth>(found.farthest[bit])});
    }
    return kept;
  }
  for (BrickParts left = parts; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const survey::Index from{cells.lo[0] + kStep * (bit >> 4), cells.lo[1] + kStep * (bit >> 2 & 3),
                             cells.lo[2] + kStep * (bit & 3)};
    const LooseBox box =
        of(survey::intersection({from, {from[0] + kStep, from[1] + kStep, from[2] + kStep}}, cells));
    render::ScreenBox part = scaled(box, scale);
    part.x0 = std::max(part.x0, brick.x0);
    part.y0 = std::max(part.y0, brick.y0);
    part.x1 = std::min(part.x1, brick.x1);
    part.y1 = std::min(part.y1, brick.y1);
    if (!part.empty()) keep(bit, part);
  }
  return kept;
}

}  // namespace footwall::isosurface
