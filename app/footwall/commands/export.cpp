// footwall export: volumes and faces in other programs' formats.
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/export_parts.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project;
  ExportChoice choice;
  ExportVolumes volumes;
  ExportFaces faces;
};

console::Output run(const Options& options, const console::Console& console) {
  if (!options.faces.asked() && !options.volumes.asked()) {
    throw Error(ErrorCode::kUsage, "nothing to export",
                "name a file with --raw, --nrrd, --segy, --vti, --vtp, --tsurf or --csv");
  }
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output{{{"files", console::Json::array()}}, ""};
  if (options.volumes.asked()) options.volumes.run(project, options.choice, console, output);
  if (options.faces.asked()) options.faces.run(project, options.choice, output);
  return output;
}

}  // namespace

void ExportChoice::add_to(CLI::App& command) {
  command.add_option("--fault", fault, "Only this fault (default: all)");
  command.add_option("--run", run, "Statistics of this run (default: the last)");
  command.add_option("--z-positive", z_positive, "Turn z: up or down, whatever the format's default")
      ->check(CLI::IsMember({"up", "down"}));
}

void add_file(console::Output& output, const std::string& file) {
  output.json["files"].push_back(file);
  output.text += "written " + file + "\n";
}

void add_export(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "export", "Write volumes and faces in other programs' formats",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  options->volumes.add_to(*command);
  options->faces.add_to(*command);
  options->choice.add_to(*command);
}

}  // namespace footwall::commands
