// The picture of isosurfaces on all ranks, whole or of what can be seen: the body of run_render(), for
// volumes that stay from picture to picture, too.
#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "engine/isosurface/parallel/extract_parallel.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/render/surface_layer.h"
#include "engine/session/render_job.h"
#include "engine/session/visible_surface.h"

namespace footwall::session {

// A volume that isosurfaces are drawn of, with what the next picture of it can use: its samples, the last
// surfaces, and what could be seen of them.
class DrawnVolume {
 public:
  // Collective; throws as StoredSamples. The volume's file must stay as it is.
  DrawnVolume(comm::Communicator& world, const std::filesystem::path& volume)
      : samples_(world, volume), visible_(samples_) {}

  // Of this rank: samples and surfaces that are kept.
  std::int64_t memory_bytes() const;
  // Whether whole() has it already.
  bool has_whole(float value, const std::string& interleave) const;

  VisibleSurface& visible() { return visible_; }
  isosurface::StoredSamples& samples() { return samples_; }
  // This rank's part of a whole isosurface; what it took to make it is 0 where it was there already.
  // Collective; throws as extract_parallel(). interleave: as RenderJob's.
  struct Whole {
    float value = 0;
    std::string interleave;
    isosurface::Extraction extraction;
  };
  std::shared_ptr<const Whole> whole(comm::Communicator& world, float value, const std::string& interleave,
                                     int threads, const JobContext& context);

 private:
  isosurface::StoredSamples samples_;
  VisibleSurface visible_;
  std::deque<std::shared_ptr<Whole>> wholes_;  // the last one made in front
};

// The volume of a file; the same object for the same path while a picture is drawn. Collective.
using VolumeOf = std::function<DrawnVolume&(const std::filesystem::path& volume)>;
// After pass n = 1, 2 ... of all isosurfaces: the picture so far, whole on rank 0. Collective.
using AfterPass = std::function<void(int pass, const render::SurfaceLayer& layer)>;

// The layer is whole on rank 0; result gets there what RenderJob::result has, but total and layer_bytes.
// Where the job names no passes' layers and after_pass is empty, no pictures of passes are made. Collective;
// throws as run_render().
render::SurfaceLayer draw_isosurfaces(comm::Communicator& world, const RenderJob& job,
                                      const VolumeOf& volume_of, const JobContext& context,
                                      const AfterPass& after_pass, nlohmann::json& result);

}  // namespace footwall::session
