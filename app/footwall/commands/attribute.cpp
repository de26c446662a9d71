// footwall attribute: a volume computed from another one, by the engine.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/make_attribute.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, kind = "discontinuity", window = "3x3x9";
  EngineOptions engine;
  tasks::AttributeOptions how;
};

console::Output run(Options& options, const console::Console& console) {
  if (options.kind != "discontinuity") {
    throw Error(ErrorCode::kUsage, fmt::format("there is no attribute '{}'", options.kind),
                "choose one of: discontinuity");
  }
  options.how.window = extract::parse_window(options.window);
  options.how.launch = options.engine.launch();
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::MadeAttribute made = tasks::make_attribute(project, options.how, console.job());
  project.close();

  const project::VolumeRecord& volume = made.volume;
  const bool any = volume.null_count < volume.dims[0] * volume.dims[1] * volume.dims[2];
  const auto value = [&](double number) { return any ? console::Json(number) : console::Json(); };
  console::Output output;
  output.json = {{"volume", volume.name},
                 {"of", made.of},
                 {"kind", options.kind},
                 {"window", extract::text_of(options.how.window)},
                 {"dims", volume.dims},
                 {"min", value(volume.min)},
                 {"max", value(volume.max)},
                 {"mean", value(volume.mean)},
                 {"null_count", volume.null_count},
                 {"role", volume.role},
                 {"high_is", "fault"},
                 {"checksum", volume.checksum},
                 {"ranks", made.ranks},
                 {"seconds", made.seconds}};
  output.text = fmt::format(
      "volume {}: discontinuity of {} in windows of {}, mean {:.4g}, on {} ranks in {:.2f} s\n", volume.name,
      made.of, extract::text_of(options.how.window), volume.mean, made.ranks, made.seconds);
  return output;
}

}  // namespace

void add_attribute(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "attribute", "Make a discontinuity volume, 0 to 1, high where faults are",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--volume", options->how.volume, "The volume to make it from (default: the first)");
  command->add_option("--kind", options->kind, "discontinuity (default)");
  command->add_option("--window", options->window,
                      "Odd numbers of inlines x crosslines x samples (default 3x3x9)");
  command->add_option("--name", options->how.name, "Name of the new volume (default: VOLUME discontinuity)");
  options->engine.add_to(*command, true);
}

}  // namespace footwall::commands
