// footwall isosurface: the surface where a volume has a value, extracted on all ranks.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/isosurface/registry.h"
#include "engine/tasks/isosurface.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, pillars = "auto", coordinates = "world", out;
  EngineOptions engine;
  tasks::IsosurfaceOptions how;
};

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
    text += options.how.cap ? "open beside nulls\n" : "open at the volume's border (--cap closes it)\n";
  }
  const console::Json& seconds = r.at("seconds");
  text += fmt::format("on {} ranks in {:.3g} s (extract {:.3g}, weld {:.3g}, measure {:.3g}, write {:.3g})\n",
                      r.at("ranks").get<int>(), seconds.at("total").get<double>(),
                      seconds.at("extract").get<double>(), seconds.at("weld").get<double>(),
                      seconds.at("measure").get<double>(), seconds.at("write").get<double>());
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
  options->engine.add_to(*command);
}

}  // namespace footwall::commands
