// The triangles of the chosen parts of bricks: extracted, projected, and those kept that can own a pixel.
#pragma once
#include <deque>
#include <span>
#include <vector>

#include "engine/isosurface/visible/brick_numbers.h"
#include "engine/isosurface/visible/detail/met_triangles.h"
#include "engine/isosurface/visible/visible_drawing.h"

namespace footwall::isosurface::detail {

struct WaveSurface {
  Surface surface;  // its triangles are those that were kept
  std::vector<render::IdRun> runs;
};

class WaveSurfaces {
 public:
  void begin(const VisibleRequest& request);
  // Extracts the chosen parts of the bricks in `bricks` (words of the whole table) from the field, keeps the
  // triangles that meet a pixel's centre which no earlier wave hides, and adds them to the frame. Returns how
  // many were kept.
  std::int64_t add(const Field& field, const survey::Box& bricks, std::span<const BrickParts> chosen,
                   const VisibleRequest& request, const BrickNumbers& numbers, const EarlierWaves& earlier);
  render::SurfaceFrame& frame() { return frame_; }
  const render::SurfaceFrame& frame() const { return frame_; }

 private:
  std::deque<WaveSurface> surfaces_;  // stay where they are; those from used_ on are room
  std::size_t used_ = 0;
  std::vector<PartRun> part_runs_;
  render::SurfaceFrame frame_;
};

}  // namespace footwall::isosurface::detail
