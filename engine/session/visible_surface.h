// Only what can be seen of a stored isosurface, extracted and drawn on all ranks, in whichever mode.
#pragma once
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/isosurface/visible/paper/visible_paper.h"
#include "engine/isosurface/visible/parallel/brick_pillars.h"
#include "engine/isosurface/visible/parallel/visible_picture_parallel.h"
#include "engine/isosurface/visible/passes.h"
#include "engine/render/composite/compose.h"
#include "storage/base/job_context.h"

namespace footwall::session {

struct DrawnVisible {
  isosurface::VisibleReport report;  // of all ranks, on rank 0
  render::SurfaceLayer layer;        // whole on rank 0
  render::ComposeReport composed;    // of this rank
  double read_seconds = 0;           // the same
  double extract_seconds = 0;        // the same, waiting included
};

// Keeps its part of the volume, and what the last picture of each of a few isovalues showed, for the next
// one.
class VisibleSurface {
 public:
  // Is given the picture as it is after each pass, whole on rank 0; collective.
  using AfterPass = std::function<void(const render::SurfaceLayer& layer)>;

  // The samples must stay.
  explicit VisibleSurface(isosurface::StoredSamples& samples) : samples_(samples) {}
  VisibleSurface(const VisibleSurface&) = delete;
  VisibleSurface& operator=(const VisibleSurface&) = delete;

  // Collective. The request's volume_size and bricks are set here. Pictures after passes take no time of
  // the budget. Throws on all ranks alike what reading volumes throws, kUsage for a picture that cannot be,
  // kUnsupported for a volume of too many bricks, kMemory, kCancelled (looked for in every pass).
  DrawnVisible draw(comm::Communicator& world, isosurface::VisibleRequest request,
                    const render::GroupOptions& groups, const JobContext& context,
                    const AfterPass& after_pass);
  // Whether mode `depth` has read its part of the volume, and what that takes.
  bool has_samples() const { return pillars_.has_value(); }
  std::int64_t sample_bytes() const { return pillars_ ? pillars_->memory_bytes() : 0; }
  // What this rank extracted, of the picture drawn last: in the volume's index space, numbered in the order
  // of the whole surface, no number twice among all ranks.
  std::span<const render::LitSurface> surfaces() const { return surfaces_; }

 private:
  void draw_depth(comm::Communicator& world, const isosurface::VisibleRequest& request,
                  const JobContext& context, const AfterPass& after_pass, DrawnVisible& drawn);
  void draw_paper(comm::Communicator& world, const isosurface::VisibleRequest& request,
                  const render::GroupOptions& groups, const JobContext& context, const AfterPass& after_pass,
                  DrawnVisible& drawn);

  struct Picture {
    float isovalue = 0;
    isosurface::VisiblePicture drawn;
  };
  Picture& picture_of(float isovalue);

  isosurface::StoredSamples& samples_;
  isosurface::VisiblePieces pieces_;                 // mode `paper`
  std::optional<isosurface::BrickPillars> pillars_;  // mode `depth`
  std::list<Picture> pictures_;                      // of mode `depth`, the last one drawn in front
  std::vector<render::LitSurface> surfaces_;
};

}  // namespace footwall::session
