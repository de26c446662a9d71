// The boxes of all 64 parts of a brick at once.
#pragma once
#include <cstdint>

#include "engine/render/depth_pyramid.h"
#include "engine/render/vector.h"
#include "storage/survey/box.h"

namespace footwall::isosurface::detail {

// By bit of BrickParts; the first and last pixel of each that may be met, held inside the picture by one
// pixel more on each side.
struct PartBoxes {
  alignas(64) std::int32_t x0[64];
  alignas(64) std::int32_t y0[64];
  alignas(64) std::int32_t x1[64];
  alignas(64) std::int32_t y1[64];
  alignas(64) std::int32_t nearest[64];
  alignas(64) std::int32_t farthest[64];
};

struct PictureSize {
  int width = 0;
  int height = 0;
};

// cells: those of the brick, cut at the volume; parts beyond are flat. False, and nothing is told, where the
// brick reaches before the near plane.
bool find_part_boxes(const render::Matrix4& to_clip, const survey::Box& cells, const PictureSize& size,
                     const render::DepthScale& scale, PartBoxes& into);

}  // namespace footwall::isosurface::detail
