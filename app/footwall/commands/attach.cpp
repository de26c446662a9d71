// footwall attach: the results of a batch job become a run of the project.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/attach.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, folder;
  tasks::AttachOptions how;
};

console::Output run(const Options& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::Attached done = tasks::attach_folder(project, options.folder, options.how, console.job());
  project.close();

  const console::Json result = console::Json::parse(done.result_json);
  console::Output output;
  output.json = {{"run", done.run}, {"volume", done.volume}};
  add_result(result, output.json);
  output.json["missing"] = done.missing;
  output.json["stale"] = console::Json::array();
  output.text = fmt::format("run {}: {} of volume {}\n", done.run, result_in_words(result), done.volume);
  for (const std::string& fault : done.missing) output.text += fmt::format("  {}: not computed yet\n", fault);
  for (const tasks::StaleFault& fault : done.stale) {
    output.json["stale"].push_back({{"fault", fault.fault}, {"faces", fault.faces}, {"stale", fault.stale}});
    output.text += fmt::format("  {}: edited since; {} of {} faces are no longer there\n", fault.fault,
                               fault.stale, fault.faces);
  }
  return output;
}

}  // namespace

void add_attach(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "attach", "Bring the results of a batch job into its project",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("folder", options->folder, "The job's folder, or its JOB.json")->required();
  command->add_option("--name", options->how.name, "Name of the run (default: the job's, or run N)");
  command->add_flag("--partial", options->how.partial, "Also where some faults are not computed yet");
}

}  // namespace footwall::commands
