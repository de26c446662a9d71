// The rectangle of pixels and the depths that boxes of cells take in, rounded so that no triangle inside can
// reach beyond, however its vertices are rounded.
#pragma once
#include "engine/isosurface/extract.h"
#include "engine/render/camera.h"
#include "engine/render/depth_pyramid.h"
#include "engine/render/lit_surface.h"

namespace footwall::isosurface {

// Before depths have a scale.
struct LooseBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = -1;
  int y1 = -1;
  double nearest = 0;
  double farthest = 1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

class ScreenBoxes {
 public:
  ScreenBoxes(const render::Camera& camera, const render::Placement& placement, int width, int height);

  // Of the cells of a box: samples box.lo to box.hi, inclusive. A box that reaches before the near plane, or
  // behind the eye, may be seen anywhere: it gets the whole picture, from depth 0 on. Empty: no pixel's
  // centre can be met.
  LooseBox of(const survey::Box& cells) const;
  render::ScreenBox scaled(const LooseBox& box, const render::DepthScale& scale) const;

  // Writes the boxes of the parts of one brick, ascending by bit, and returns those that are not empty, for
  // which alone there are boxes. `cells`: of the brick, cut at the volume. brick: its own box, beyond which
  // no pixel of a part's lies. into: room for all parts.
  BrickParts of_parts(const survey::Box& cells, BrickParts parts, const render::ScreenBox& brick,
                      const render::DepthScale& scale, render::ScreenBox* into) const;

  const render::Matrix4& to_clip() const { return to_clip_; }

 private:
  render::Matrix4 to_clip_;
  int width_;
  int height_;
};

}  // namespace footwall::isosurface
