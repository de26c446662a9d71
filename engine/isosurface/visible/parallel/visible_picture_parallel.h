// The picture of only what can be seen of an isosurface, on all ranks: drawn in waves (visible_drawing.h),
// merged in log2 steps, whole on rank 0.
#pragma once
#include <functional>

#include "engine/isosurface/visible/parallel/world_ranks.h"
#include "engine/isosurface/visible/visible_drawing.h"
#include "engine/render/composite/compose.h"

namespace footwall::isosurface {

// Keeps its room, and what the last picture showed.
class VisiblePicture {
 public:
  // Is given the picture as it is after each wave; collective.
  using AfterWave = std::function<void(int wave, const render::SurfaceLayer& layer)>;

  // Collective; the layer is whole on rank 0 and shows nothing elsewhere. parts: of this rank; those of all
  // ranks hold every brick once. Throws on all ranks alike (AgreedError) what VisibleDrawing::draw() throws,
  // and kCancelled, which each step of each wave looks for.
  render::SurfaceLayer draw(comm::Communicator& world, std::span<const VolumePart> parts,
                            const VisibleRequest& request, VisibleReport& report,
                            render::ComposeReport& composed, const AfterWave& after_wave = {},
                            const JobContext& job = {});
  // The volume has changed.
  void forget() { drawing_.forget(); }
  VisibleDrawing& drawing() { return drawing_; }
  // What pictures after the waves of the last draw() took on this rank.
  double aside_seconds() const { return aside_seconds_; }

 private:
  VisibleDrawing drawing_;
  render::Composer composer_;
  double aside_seconds_ = 0;
};

}  // namespace footwall::isosurface
