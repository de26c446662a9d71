// The picture of a project: faults coloured by a statistic of a run, sections of a volume, isosurfaces.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/fault_picture.h"
#include "engine/tasks/render_isosurfaces.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct RenderOptions {
  bool faults = true;
  std::vector<std::string>
      sections;        // "inline=N", "crossline=N", "z=VALUE"; N may be "first", "middle" or "last"
  std::string volume;  // for sections; empty: the first
  std::vector<std::string> isosurfaces;  // "VOLUME=VALUE[,COLOUR]"
  DrawingOptions drawing;                // of isosurfaces
  std::filesystem::path pass_images;     // with drawing.visible: a folder (visible.h); empty: none
  std::string statistic = "variance";
  std::string colours;  // empty: the statistic's own colour map
  std::optional<std::array<double, 2>> range;
  std::optional<std::int64_t> run;
  int width = 1600;
  int height = 1000;
  std::string camera;             // see render_camera.h; empty: as the next three say
  std::optional<double> azimuth;  // none: chosen
  double elevation = 25;
  double zoom = 1;
  double exaggeration = 0;  // 0: chosen
  double velocity = 0;      // m/s; 0: 1 ms is drawn as 1 m
  int threads = 0;
  std::filesystem::path depth;  // TIFF of the window depth; empty: none
};

struct Rendered {
  render::View view;  // what was looked at; without azimuth where that was chosen
  std::int64_t faces = 0;
  std::vector<std::string> isosurfaces;  // their names
  std::vector<std::int64_t> triangles;   // of each isosurface
  std::vector<std::string> pass_images;  // files
  std::string engine_json;               // session/render_job.h; empty where there was nothing for the engine
  std::vector<std::string> notices;      // stale or never computed colours, isosurfaces that are not finished
};

// Throws kUsage for options that make no sense, kInvalid for a line that the survey does not have, kNotFound
// for a volume that is not there, and what the engine throws.
Rendered render_faults(const project::Project& project, const RenderOptions& options,
                       const std::filesystem::path& out, const JobContext& job);

}  // namespace footwall::tasks
