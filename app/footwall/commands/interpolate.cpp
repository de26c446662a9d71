// footwall interpolate: pillars between picked ones.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/triangulate.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, fault;
  bool remove = false;
  tasks::InterpolateOptions how;
};

console::Output run(const Options& options, const console::Console& console) {
  const int modes = options.how.every.has_value() + options.how.tolerance.has_value() + options.remove;
  if (modes != 1) {
    throw Error(ErrorCode::kUsage, "exactly one of --every, --tolerance and --remove is needed",
                "e.g. --every 4");
  }
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const char* what = options.remove ? "removed" : "inserted";
  console::Output output{{{what, 0}, {"faults", console::Json::array()}}, ""};
  std::int64_t total = 0;
  for (const project::FaultRecord& fault : tasks::chosen_faults(project, options.fault)) {
    if (options.fault.empty() && project.surface_of(fault.id)) continue;  // it has no pillars
    const std::int64_t n = options.remove
                               ? tasks::remove_interpolated(project, fault)
                               : tasks::interpolate_fault(project, fault, options.how, console.job());
    output.json["faults"].push_back({{"name", fault.name}, {what, n}});
    output.text += fmt::format("{}: {} interpolated pillars {}\n", fault.name, n, what);
    total += n;
  }
  output.json[what] = total;
  project.close();
  return output;
}

}  // namespace

void add_interpolate(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "interpolate", "Insert pillars between picked ones (one undoable edit a fault)",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--fault", options->fault, "Only this fault (default: all)");
  command->add_option("--every", options->how.every, "Pillars at most this many lines apart");
  command->add_flag("--remove", options->remove, "Take the interpolated pillars away");
  command->add_option(
      "--tolerance", options->how.tolerance,
      "Insert where the smooth surface differs by more than this many voxels from straight lines");
}

}  // namespace footwall::commands
