// footwall isosurface: the surface where a volume has a value, extracted on all ranks.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "app/footwall/commands/visible_options.h"
#include "engine/isosurface/registry.h"
#include "engine/tasks/isosurface.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, pillars = "auto", coordinates = "world", out;
  std::string camera, size;
  std::optional<double> exaggeration;
  VisibleOptions visible;
  EngineOptions engine;
  tasks::IsosurfaceOptions how;
};

// Throws kUsage for options of a view without --visible, and for --visible without a camera.
std::optional<tasks::SeenFrom> seen_from(const Options& options) {
  const std::optional<session::VisibleChoice> choice = options.visible.choice();
  if (!choice) {
    const char* option = !options.camera.empty() ? "--camera" : !options.size.empty() ? "--size" : nullptr;
    if (option == nullptr && options.exaggeration) option = "--exaggeration";
    if (option == nullptr) return std::nullopt;
    throw Error(ErrorCode::kUsage,
                std::string(option) + " is of use only where what can be seen is extracted",
                "add --visible; footwall render makes pictures");
  }
  if (options.camera.empty()) {
    throw Error(ErrorCode::kUsage, "--visible needs a place to see from",
                "give --camera: a saved view's name, azimuth,elevation,zoom as 30,25,1, or eye;target;up");
  }
  tasks::SeenFrom seen;
  seen.choice = *choice;
  seen.camera = options.camera;
  if (!options.size.empty()) {
    const auto [width, height] = picture_size_from(options.size);
    seen.width = width;
    seen.height = height;
  }
  seen.exaggeration = options.exaggeration.value_or(0);
  seen.pass_images = options.visible.pass_images;
  return seen;
}

// What bounds the surface, in words.
const char* open_at(const Options& options) {
  if (options.visible.visible) return "open where it is hidden, and at the volume's border\n";
  return options.how.cap ? "open beside nulls\n" : "open at the volume's border (--cap closes it)\n";
}

// "12 components (3 closed), genus 0, ..."
std::string in_words(const console::Json& r, const Options& options) {
  const auto unit = r.at("unit").get<std::string>();
  std::string text =
      fmt::format("{} triangles, {} vertices, area {:.6g} {}^2\n", r.at("triangles").get<std::uint64_t>(),
                  r.at("vertices").get<std::uint64_t>(), r.at("area").get<double>(), unit);
  const auto components = r.at("components").get<std::uint64_t>();
  text += fmt::format("{} component{}, {} closed, genus {}, Euler number {}, ", components,
                      components == 1 ? "" : "s", r.at("closed_components").get<std::uint64_t>(),
                      r.at("genus").get<std::int64_t>(), r.at("euler").get<std::int64_t>());
  if (!r.at("enclosed_volume").is_null()) {
    text += fmt::format("encloses {:.6g} {}^3\n", r.at("enclosed_volume").get<double>(), unit);
  } else {
    text += open_at(options);
  }
  const console::Json& seconds = r.at("seconds");
  text += fmt::format("on {} ranks in {:.3g} s (extract {:.3g}, weld {:.3g}, measure {:.3g}, write {:.3g})\n",
                      r.at("ranks").get<int>(), seconds.at("total").get<double>(),
                      seconds.at("extract").get<double>(), seconds.at("weld").get<double>(),
                      seconds.at("measure").get<double>(), seconds.at("write").get<double>());
  if (options.visible.visible) {
    text += passes_in_words(r);
    if (!options.out.empty()) text += fmt::format("\nwritten {}", options.out);
    return text;
  }
  text += fmt::format(
      "pillars {}, load imbalance {:.1f} %, {} intersections computed more than once, {} samples stored "
      "more than once",
      r.at("pillars").get<std::string>(), 100 * r.at("load_imbalance").get<double>(),
      r.at("redundant_intersections").get<std::int64_t>(), r.at("overlap_samples").get<std::int64_t>());
  if (!options.out.empty()) text += fmt::format("\nwritten {}", options.out);
  return text;
}

console::Output run(Options& options, const console::Console& console) {
  if (options.coordinates != "world" && options.coordinates != "index") {
    throw Error(ErrorCode::kUsage, fmt::format("there are no '{}' coordinates", options.coordinates),
                "choose one of: world, index");
  }
  options.how.world = options.coordinates == "world";
  if (options.pillars != "auto") options.how.pillars = isosurface::parse_interleaving(options.pillars);
  options.how.visible = seen_from(options);
  options.how.launch = options.engine.launch();
  options.how.out = options.out;
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  const tasks::IsosurfaceMade made = tasks::make_isosurface(project, options.how, console.job());
  for (const std::string& notice : made.notices) log::warn(notice);
  const console::Json result = console::Json::parse(made.result);
  console::Output output;
  output.json = {{"volume", made.volume}, {"value", options.how.value}};
  if (!options.out.empty()) output.json["out"] = options.out;
  output.json.update(result);
  if (options.how.visible) {
    output.json.erase("pass_layers");
    output.json["pass_images"] = made.pass_images;
  }
  output.json["notices"] = made.notices;
  output.text = in_words(result, options);
  return output;
}

}  // namespace

void add_isosurface(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "isosurface", "Extract the surface where a volume has a value, and measure it",
                  [options](console::Console& console) { return run(*options, console); });
  tasks::IsosurfaceOptions& how = options->how;
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--volume", how.volume, "The volume (default: the first)");
  command->add_option("--value", how.value, "The value, in the volume's unit")->required();
  command->add_option("--out", options->out,
                      "The file to write: .vtp, .stl, .ply, .ts or .h5 (default: none)");
  command->add_option("--coordinates", options->coordinates, "Of the file: world (default) or index");
  command->add_flag("--cap", how.cap, "Close the surface along the volume's border");
  command->add_option("--largest", how.largest, "Keep only this many of the largest components, by area");
  command->add_option(
      "--min-area", how.min_area,
      "Keep only components at least so large: m^2, or voxel^2 in a time survey without --velocity");
  command->add_option(
      "--velocity", how.velocity,
      "m/s, for areas and volumes in metres in a time survey (default: they are told in voxels)");
  command->add_option(
      "--pillars", options->pillars,
      "Pillars of each rank along inlines x crosslines, and layers along samples, as 4x2x1; or auto "
      "(default): chosen from the min/max pyramid");
  std::string names;
  for (const isosurface::Variant& variant : isosurface::variants())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", variant.name);
  command->add_option("--variant", how.variant,
                      "How to extract; each gives the same surface: " + names + " (default bricks)");
  options->visible.add_to(*command);
  command->add_option(
      "--camera", options->camera,
      "With --visible: a saved view's name, azimuth,elevation,zoom, or eye;target;up as x,y,z "
      "each, as of footwall render");
  command->add_option("--size", options->size,
                      "With --visible: pixels of the picture that shows it (default 1600x1000)");
  command->add_option(
      "--exaggeration", options->exaggeration,
      "With --visible: of heights, as of footwall render (default: the saved view's, or chosen)");
  options->engine.add_to(*command, true);
}

}  // namespace footwall::commands
