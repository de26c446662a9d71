// Mode `depth`: only what can be seen of an isosurface is extracted and drawn, in waves, and the picture is
// that of the whole isosurface, bit for bit.
//
// A part of a brick (2 x 2 x 2 cells) is given up only where the depths that earlier waves drew hide all of
// its box: that cannot be wrong, whatever order parts are drawn in. The order decides how much is drawn in
// vain: in a wave come the parts that no other part hides, as far as boxes can tell that nothing was made of
// (each is taken for a wall over the middle of its box); the last wave takes whatever is left. What a wave
// takes follows from the volume, the camera and the merged depths of the waves before, so that it does not
// depend on who does it.
// Based on: seed 003 (octree, waves of visible cells, extraction spread over ranks, waves that can be the
// last); differs in that depths decide and not a mask of pixels, that ranks test their own bricks, that data
// stay where they are, and that waves look ahead.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/isosurface/visible/passes.h"
#include "engine/isosurface/visible/ranks.h"
#include "engine/render/surface_frame.h"
#include "engine/render/visibility.h"

namespace footwall::isosurface {

// What a rank has of the volume: all cells of the bricks in a box of bricks, with samples one more before and
// one more behind, for gradients. The boxes of all ranks are disjoint and hold every brick.
struct VolumePart {
  Field field;
  survey::Box bricks;
};

class VisibleDrawing {
 public:
  VisibleDrawing();
  ~VisibleDrawing();
  VisibleDrawing(const VisibleDrawing&) = delete;
  VisibleDrawing& operator=(const VisibleDrawing&) = delete;

  // All ranks call it with the same request. parts: must stay until shade(). What the last picture showed of
  // the same volume and isovalue is the first wave of the next one: call forget() when the volume changes.
  // after_wave is told the number of each wave, from 1 on, when its triangles are drawn; what it does takes
  // no time of the budget. Throws Error kUsage for a picture that cannot be, kInvalid for parts that do not
  // fit, kUnsupported for too many bricks, kMemory.
  VisibleReport draw(Ranks& ranks, std::span<const VolumePart> parts, const VisibleRequest& request,
                     const std::function<void(int wave)>& after_wave = {});
  void forget();

  // What this rank drew; numbers as BrickNumbers gives them. Of the last wave that was drawn, too, while
  // after_wave runs.
  const render::VisibilityBuffer& window() const;
  render::VisibilityBuffer& window();
  // All surfaces that this rank drew, to be shaded where they are seen.
  render::SurfaceFrame& frame();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::isosurface
