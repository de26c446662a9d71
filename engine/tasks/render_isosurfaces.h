// Isosurfaces of a project's volumes, drawn by the engine for a picture.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/camera.h"
#include "engine/render/scene.h"
#include "engine/render/scene_frame.h"
#include "engine/render/surface_layer.h"
#include "engine/session/launch.h"
#include "engine/session/visible_choice.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// One --isosurface: VOLUME=VALUE[,COLOUR].
struct WantedIsosurface {
  project::VolumeRecord volume;
  double value = 0;
  render::Rgba colour = 0;
  std::string name;  // "amplitude = 0.25"
};

// COLOUR: a name or #rrggbb; without one the n-th of a set. Throws kUsage for other words and for a value
// that is not finite as a float32, kNotFound for a volume that is not there.
std::vector<WantedIsosurface> isosurfaces_from(const project::Project& project,
                                               const std::vector<std::string>& words);

// The colour that the n-th isosurface has unless another is asked for.
render::Rgba isosurface_colour(std::size_t n);
// From the volume's own index space, which begins at its origin in the survey's, to the scene.
render::Placement placement_of(const project::VolumeRecord& volume, const render::SceneFrame& frame);

struct DrawingOptions {
  session::LaunchOptions launch;
  std::optional<double> group_threshold = 0.1;    // none: by estimated times
  std::optional<session::VisibleChoice> visible;  // only what can be seen; pass_layers is set here
  // With `visible`: is told of the layers after all passes, before they are removed.
  std::function<void(const session::VisibleChoice& choice, int count)> after_passes;
};

struct DrawnIsosurfaces {
  render::SurfaceLayer layer;
  std::vector<std::int64_t> triangles;  // of each
  std::string
      result_json;  // the engine's, see session/render_job.h; uncovered pixels as count_pixels() has them
};

// width, height: of the layer. Throws what the engine does (session::run_engine).
DrawnIsosurfaces draw_isosurfaces(const project::Project& project,
                                  const std::vector<WantedIsosurface>& wanted,
                                  const render::SceneFrame& frame, const render::Camera& camera, int width,
                                  int height, const DrawingOptions& options, const JobContext& job);

}  // namespace footwall::tasks
