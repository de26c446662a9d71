// The picture of surfaces that are spread over ranks: each rank draws its own (or its group's), pictures are
// merged in log2 steps, and rank 0 gets the whole. The pixels are the same, bit for bit, for every number of
// ranks, decomposition, grouping and number of threads: which triangle a pixel shows is the least of (depth,
// number), and numbers are those of the whole surface.
// Based on: seed 000, section 5.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/render/composite/groups.h"
#include "engine/render/surface_frame.h"
#include "engine/render/surface_layer.h"

namespace footwall::render {

struct ComposeOptions {
  int width = 0;
  int height = 0;
  int threads = 1;  // of each rank
  GroupOptions groups;
};

// Of this rank.
struct ComposeReport {
  struct Seconds {
    double group = 0;
    double project = 0;
    double rasterize = 0;
    double shade = 0;
    double merge = 0;   // with the waiting for partners
    double gather = 0;  // with the waiting, too
  } seconds;
  std::int64_t triangles = 0;      // that this rank drew, its group's included
  std::int64_t merged_pixels = 0;  // sent to be merged
  std::int64_t merged_bytes = 0;   // sent for that
  std::int64_t bytes = 0;          // sent for all
  std::int64_t messages = 0;       // the same
  int group_steps = 0;             // steps of Halving done by sharing geometry
};

// Keeps its room from picture to picture.
class Composer {
 public:
  // Collective; the layer is whole on rank 0 and shows nothing elsewhere. The surfaces must be sound
  // (lit_surface.h), and no number may be used twice among all ranks. Large pictures are made in bands, so
  // that a rank holds at most kMostPixels of a picture. What fails before ranks depend on each other fails on
  // all (AgreedError): kUsage for a size that cannot be, kMemory.
  SurfaceLayer compose(comm::Communicator& world, std::span<const LitSurface> surfaces, const Camera& camera,
                       const ComposeOptions& options, ComposeReport& report);
  // The same for pictures that are drawn already, in another way: `window` is this rank's whole picture,
  // which shows triangles of `frame` (numbered); what it shows after that is of no use.
  SurfaceLayer compose_drawn(comm::Communicator& world, SurfaceFrame& frame, VisibilityBuffer& window,
                             const ComposeOptions& options, ComposeReport& report);
  static constexpr std::int64_t kMostPixels = std::int64_t{1} << 24;

 private:
  void draw(Rows rows, const ComposeOptions& options, ComposeReport& report);
  // Which rows of the band are left on this rank, merged of all.
  Rows merge(comm::Communicator& world, const Halving& halving, int steps_done, Rows band,
             ComposeReport& report);
  void gather(comm::Communicator& world, const Halving& halving, Rows rows, SurfaceLayer& layer,
              ComposeReport& report);

  SurfaceFrame frame_;
  std::optional<VisibilityBuffer> window_;  // none: this rank has no rows
  std::vector<Rgba> colours_;
  comm::Bytes part_;
};

}  // namespace footwall::render
