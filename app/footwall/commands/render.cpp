// footwall render: a picture by the engine's own rasterizer.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "app/footwall/commands/visible_options.h"
#include "engine/tasks/render_camera.h"
#include "engine/tasks/render_faults.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, out, size = "1600x1000", range, depth, save_view, group_threshold;
  bool faults = false;
  VisibleOptions visible;
  EngineOptions engine;
  tasks::RenderOptions how;
};

void add_isosurfaces(const tasks::Rendered& done, const Options& options, console::Output& output) {
  if (done.engine_json.empty()) return;
  const console::Json engine = console::Json::parse(done.engine_json);
  for (std::size_t n = 0; n < done.isosurfaces.size(); ++n) {
    console::Json each{{"name", done.isosurfaces[n]}, {"triangles", done.triangles[n]}};
    output.text += fmt::format("\n{}: {} triangles", done.isosurfaces[n], done.triangles[n]);
    if (options.visible.visible) {
      const console::Json& report = engine.at("isosurfaces").at(n);
      each.update(report);
      output.text += "\n" + passes_in_words(report);
    }
    output.json["isosurfaces"].push_back(std::move(each));
  }
  for (const char* key : {"ranks", "seconds", "merged_pixels", "merged_bytes", "bytes_sent", "messages"})
    output.json[key] = engine.at(key);
  if (!options.visible.visible) return;
  output.json["mode"] = engine.at("mode");
  output.json["pass_images"] = done.pass_images;
}

console::Output run(Options& options, const console::Console& console) {
  if (!options.faults && options.how.sections.empty() && options.how.isosurfaces.empty()) {
    throw Error(ErrorCode::kUsage, "nothing to draw", "add --faults, --section or --isosurface");
  }
  options.how.drawing.visible = options.visible.choice();
  options.how.pass_images = options.visible.pass_images;
  if (options.visible.visible && options.how.isosurfaces.empty()) {
    throw Error(ErrorCode::kUsage, "--visible is of isosurfaces, and there is none to draw",
                "add --isosurface VOLUME=VALUE, or leave it out");
  }
  const bool saves = !options.save_view.empty();
  if (saves) {
    project::check_name("view", options.save_view);
    if (options.how.camera.empty() && !options.how.azimuth) {
      throw Error(ErrorCode::kUsage, "--save-view needs a direction to save", "give --camera or --azimuth");
    }
  }
  if (options.how.threads > 0) options.engine.threads = options.how.threads;
  options.how.drawing.launch = options.engine.launch();
  if (!options.group_threshold.empty())
    options.how.drawing.group_threshold = group_threshold_from(options.group_threshold);
  options.how.depth = options.depth;
  const auto [width, height] = picture_size_from(options.size);
  options.how.faults = options.faults;
  options.how.width = width;
  options.how.height = height;
  if (!options.range.empty()) options.how.range = range_from(options.range, "--range");
  project::Project project =
      open_project(options.project, saves ? project::OpenMode::kWrite : project::OpenMode::kRead);
  const tasks::Rendered done = tasks::render_faults(project, options.how, options.out, console.job());
  for (const std::string& notice : done.notices) log::warn(notice);
  console::Output output{
      {{"out", options.out}, {"size", {width, height}}, {"faces", done.faces}, {"notices", done.notices}},
      fmt::format("written {}: {} faces, {} x {} pixels", options.out, done.faces, width, height)};
  add_isosurfaces(done, options, output);
  if (saves) {
    project.save_view(
        {options.save_view, tasks::camera_words(done.view), done.view.exaggeration, std::string()});
    project.close();
    output.json["view"] = options.save_view;
    output.text += fmt::format("\nview {} saved", options.save_view);
  }
  return output;
}

}  // namespace

void add_render(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "render", "Draw faults coloured by a statistic, sections and isosurfaces",
                  [options](console::Console& console) { return run(*options, console); });
  tasks::RenderOptions& how = options->how;
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--out", options->out, "The PNG file to write")->required();
  command->add_flag("--faults", options->faults, "Draw the fault meshes");
  command->add_option("--section", how.sections,
                      "inline=N, crossline=N or z=VALUE; N may be first, middle or last; may be repeated");
  command->add_option("--isosurface", how.isosurfaces,
                      "VOLUME=VALUE or VOLUME=VALUE,COLOUR (a name or #rrggbb); may be repeated");
  command->add_option("--statistic", how.statistic, "What colours the faults (default variance)");
  command->add_option("--run", how.run, "Statistics of this run (default: the last)");
  command->add_option("--volume", how.volume, "The volume of the sections (default: the first)");
  command->add_option("--range", options->range,
                      "Values at the ends of the colour bar, low:high (default: 2nd to 98th percentile)");
  command->add_option("--colours", how.colours,
                      "Colour map: viridis, cividis, grey, red-white-blue, seismic");
  command->add_option("--size", options->size, "Pixels (default 1600x1000)");
  CLI::Option* azimuth = command->add_option(
      "--azimuth", how.azimuth,
      "Direction looked in, degrees clockwise from north (default: that of twelve, 30, 45 and "
      "60 degrees to the survey's lines, which shows most of the faults and sections)");
  CLI::Option* elevation =
      command->add_option("--elevation", how.elevation, "Degrees above the horizon (default 25)");
  CLI::Option* zoom = command->add_option("--zoom", how.zoom, "1 fits the survey's box (default 1)");
  command
      ->add_option(
          "--camera", how.camera,
          "A saved view's name, azimuth,elevation,zoom, or eye;target;up as x,y,z each, metres east, "
          "north and up from the survey's centre")
      ->excludes(azimuth)
      ->excludes(elevation)
      ->excludes(zoom);
  command->add_option("--save-view", options->save_view,
                      "Keep the camera and the exaggeration under this name, for --camera");
  command->add_option(
      "--exaggeration", how.exaggeration,
      "Vertical exaggeration (default: a round one that makes the box about 0.6 as high as long)");
  command->add_option("--velocity", how.velocity,
                      "m/s, for heights in a time survey (default: 1 ms is drawn as 1 m)");
  options->visible.add_to(*command);
  command->add_option("--depth", options->depth,
                      "Also write the depth, 0 near to 1 background, to this TIFF file");
  command->add_option("--ranks", options->engine.ranks,
                      "MPI ranks for isosurfaces (default: the tasks of Slurm's allocation, else the smaller "
                      "of 4 and the usable cores)");
  options->engine.add_running_to(*command);
  command->add_option(
      "--group-threshold", options->group_threshold,
      "Ranks share triangles rather than pictures up to this share of a picture's bytes "
      "(default 0.1), or auto: where it is estimated to be quicker; the picture is the same for all");
  command->add_option("--threads", how.threads, "Threads (default: all; for isosurfaces 1 a rank)");
}

}  // namespace footwall::commands
