// An isosurface of a project's volume, extracted by the engine and written to a file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/isosurface/parallel/pillars.h"
#include "engine/session/launch.h"
#include "engine/session/visible_choice.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// From where an isosurface is looked at, where only what can be seen of it is wanted: as `render` draws it.
struct SeenFrom {
  session::VisibleChoice choice;  // pass_layers is set by the task
  std::string camera;             // render_camera.h
  int width = 1600;               // of the picture, each of whose pixels has kSamples x kSamples samples
  int height = 1000;
  double exaggeration = 0;            // of heights; 0: the saved view's, or chosen
  std::filesystem::path pass_images;  // a folder (visible.h); empty: none
};

struct IsosurfaceOptions {
  std::string volume;  // empty: the first one
  double value = 0;
  std::string variant = "bricks";                   // how to extract: of isosurface/registry.h
  std::optional<isosurface::Interleaving> pillars;  // none: chosen
  bool world = true;                                // coordinates of the file; else index space
  bool cap = false;
  std::uint64_t largest = 0;       // components to keep; 0: all
  double min_area = 0;             // of a component
  std::optional<double> velocity;  // m/s, for areas and volumes; with `visible` for heights, too
  std::filesystem::path out;       // .h5, or a suffix of write_surface.h; empty: the surface is only measured
  session::LaunchOptions launch;
  std::optional<SeenFrom>
      visible;  // only what can be seen; not with variant, pillars, cap, largest, min_area
};

struct IsosurfaceMade {
  std::string volume;                    // its name
  std::string result;                    // the engine's JSON (engine/session/isosurface_job.h), see visible.h
  std::vector<std::string> pass_images;  // files
  std::vector<std::string> notices;  // what the user should know: a value that no sample comes near, a budget
};

// Throws kUsage (a value, an area, a suffix or a camera that cannot be, options that exclude each other),
// kNotFound (no such volume, naming those there are, or its file is not there), and the engine's own errors.
// A failure or cancel leaves no part of a file, and one that stood there before as it was.
IsosurfaceMade make_isosurface(const project::Project& project, const IsosurfaceOptions& options,
                               const JobContext& job);

}  // namespace footwall::tasks
