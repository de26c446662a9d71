// footwall triangulate: pillars to meshes.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/triangulate.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, fault;
  tasks::TriangulateOptions how;
};

console::Output run(const Options& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  console::Output output{{{"faults", console::Json::array()}}, ""};
  for (const project::FaultRecord& fault : tasks::chosen_faults(project, options.fault)) {
    const tasks::Triangulated done = tasks::triangulate_fault(project, fault, options.how, console.job());
    output.json["faults"].push_back(
        {{"name", done.fault}, {"vertices", done.vertices}, {"faces", done.faces}, {"notes", done.notes}});
    output.text += fmt::format("{}: {} vertices, {} faces\n", done.fault, done.vertices, done.faces);
    for (const std::string& note : done.notes) output.text += "  " + note + "\n";
  }
  project.close();
  return output;
}

}  // namespace

void add_triangulate(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "triangulate", "Make triangle meshes from pillars",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--fault", options->fault, "Only this fault (default: all)");
  command->add_option("--detail", options->how.detail,
                      "Largest distance from the ruled surface between pillars, in voxels (default 0.5)");
  command->add_option("--max-edge", options->how.max_edge, "Longest edge, in voxels (default 16)");
  command->add_option("--tie", options->how.tie,
                      "Pillars that cross within this many voxels are tied (default 2)");
  command->add_flag("--rechart", options->how.rechart, "Fit the fault's chart anew; every panel may change");
}

}  // namespace footwall::commands
