#include "engine/tasks/isosurface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/isosurface/registry.h"
#include "engine/render/fault_picture.h"
#include "engine/render/picture.h"
#include "engine/session/isosurface_job.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/job_home.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/render_camera.h"
#include "engine/tasks/render_isosurfaces.h"
#include "engine/tasks/visible.h"
#include "engine/tasks/write_surface.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"
#include "storage/surface/surface_file.h"

namespace footwall::tasks {
namespace {

bool is_hdf5(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return suffix == ".h5";
}

void check_visible(const IsosurfaceOptions& options) {
  const auto refuse = [](const char* option, const char* why) {
    throw Error(ErrorCode::kUsage, fmt::format("{} cannot be used with --visible: {}", option, why),
                "leave one of the two out");
  };
  if (options.cap) refuse("--cap", "what can be seen is never closed");
  if (options.largest > 0) refuse("--largest", "components are those of the whole surface");
  if (options.min_area > 0) refuse("--min-area", "components are those of the whole surface");
  if (options.pillars) refuse("--pillars", "the work is shared by what can be seen");
  if (options.variant != isosurface::variants().front().name)
    refuse("--variant", "what can be seen is found with bricks");
  const SeenFrom& seen = *options.visible;
  if (seen.width < 1 || seen.height < 1 || seen.width > render::kLargestPicture ||
      seen.height > render::kLargestPicture) {
    throw Error(ErrorCode::kUsage,
                fmt::format("a picture of {} x {} pixels cannot be drawn", seen.width, seen.height),
                fmt::format("give 1 to {} pixels each way", render::kLargestPicture));
  }
}

void check(const IsosurfaceOptions& options) {
  isosurface::variant_of(options.variant);
  constexpr double kMost = std::numeric_limits<float>::max();
  if (!(std::abs(options.value) <= kMost)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("--value {} is no value that a sample can have", options.value),
                "give a finite number");
  }
  if (!(options.min_area >= 0) || !std::isfinite(options.min_area))
    throw Error(ErrorCode::kUsage, fmt::format("--min-area {} is no area", options.min_area),
                "give 0 or more");
  if (options.velocity && !(*options.velocity > 0 && std::isfinite(*options.velocity))) {
    throw Error(ErrorCode::kUsage, fmt::format("--velocity {} is no velocity", *options.velocity),
                "give a number above 0, in m/s");
  }
  if (options.visible) check_visible(options);
  if (options.out.empty() || is_hdf5(options.out)) return;
  try {
    surface_format_of(options.out);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), error.hint() + "; or .h5");
  }
}

isosurface::Surface as_surface(const surface::StoredSurface& stored) {
  isosurface::Surface surface;
  const std::size_t vertices = stored.positions.size() / 3;
  surface.positions.resize_uninitialised(vertices);
  surface.normals.resize_uninitialised(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto position = [&](std::size_t axis) {
      return static_cast<float>(stored.positions[3 * v + axis]);
    };
    surface.positions[v] = {position(0), position(1), position(2)};
    surface.normals[v] = {stored.normals[3 * v], stored.normals[3 * v + 1], stored.normals[3 * v + 2]};
  }
  surface.triangles.resize_uninitialised(stored.triangles.size() / 3);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    surface.triangles[t] = {stored.triangles[3 * t], stored.triangles[3 * t + 1],
                            stored.triangles[3 * t + 2]};
  return surface;
}

// What `render --isosurface` draws from there, of which the camera is a part.
render::Composition composition_of(const project::Project& project, const survey::Geometry& survey,
                                   const project::VolumeRecord& volume, const IsosurfaceOptions& options) {
  const SeenFrom& seen = *options.visible;
  render::FaultPicture picture;
  picture.geometry = survey;
  picture.title = project.path().stem().string();
  picture.view.exaggeration = seen.exaggeration;
  picture.view.velocity = options.velocity.value_or(0);
  take_camera(project, seen.camera, picture.view);
  picture.isosurfaces_title = volume.name;
  picture.isosurfaces.push_back({text::shortest(options.value), isosurface_colour(0)});
  return render::compose(picture, seen.width, seen.height);
}

session::VisibleView view_of(const render::Composition& made, const project::VolumeRecord& volume,
                             const SeenFrom& seen) {
  session::VisibleView view;
  view.choice = seen.choice;
  view.camera = made.camera;
  view.placement = placement_of(volume, made.frame);
  view.width = seen.width * render::kSamples;
  view.height = seen.height * render::kSamples;
  view.colour = isosurface_colour(0);
  return view;
}

}  // namespace

IsosurfaceMade make_isosurface(const project::Project& project, const IsosurfaceOptions& options,
                               const JobContext& context) {
  check(options);
  if (!options.out.empty()) refuse_to_replace_storage(options.out);
  const std::optional<survey::Geometry> survey = project.survey();
  const project::VolumeRecord of = present_volume(project, options.volume);
  require(survey.has_value(), "a project with a volume has a survey");
  IsosurfaceMade made;
  made.volume = of.name;
  const auto value = static_cast<float>(options.value);
  if (value < of.min || value > of.max) {
    made.notices.push_back(
        fmt::format("the values of volume '{}' run from {:g} to {:g}: no surface is at {:g}", of.name, of.min,
                    of.max, options.value));
  }
  const bool direct = !options.out.empty() && is_hdf5(options.out);
  const session::PrivateFolder folder(home_of_job(project));
  session::IsosurfaceJob job;
  job.volume = std::filesystem::absolute(project.volume_path(of));
  if (!options.out.empty())
    job.output = direct ? std::filesystem::absolute(options.out) : folder.path() / "surface.h5";
  job.result = folder.path() / "result.json";
  job.value = value;
  job.variant = options.variant;
  job.pillars = options.pillars;
  job.world = direct && options.world;
  job.cap = options.cap;
  job.largest = options.largest;
  job.min_area = options.min_area;
  job.velocity = options.velocity;
  std::optional<render::Composition> seen;
  PassImages images(options.visible ? options.visible->pass_images : "");
  if (options.visible) {
    seen = composition_of(project, *survey, of, options);
    job.visible = view_of(*seen, of, *options.visible);
    if (images.are_wanted()) job.visible->choice.pass_layers = folder.path() / "pass";
  }
  const std::filesystem::path job_file = folder.path() / "ISOSURFACE.json";
  session::write_isosurface_job(job, job_file);
  const bool converts = !options.out.empty() && !direct;
  try {
    made.result = session::run_engine(options.launch, {{"isosurface", job_file.string()}, job.result},
                                      context.part(0, converts ? 0.8 : 1));
  } catch (...) {
    if (direct) remove_partial_files_of(job.output);  // of an engine that was killed
    throw;
  }
  if (options.visible) {
    auto result = nlohmann::json::parse(made.result);
    count_pixels(result);
    made.result = result.dump();
    std::string notice = end_notice("the isosurface", options.visible->choice, result);
    if (!notice.empty()) made.notices.push_back(std::move(notice));
    if (images.are_wanted()) {
      images.write(job.visible->choice, result.at("pass_layers").get<int>(), *seen, options.visible->width,
                   options.visible->height, options.launch.threads, {});
    }
    made.pass_images = images.paths();
  }
  if (converts) {
    const isosurface::Surface surface = as_surface(surface::read_surface(job.output));
    write_surface(options.out, surface, fmt::format("{} {:g}", of.name, options.value), *survey,
                  options.world ? SurfaceCoordinates::kWorld : SurfaceCoordinates::kIndex,
                  context.part(0.8, 1));
  }
  return made;
}

}  // namespace footwall::tasks
