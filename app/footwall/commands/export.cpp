// footwall export: volumes, faces and sticks in other programs' formats.
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
  ExportFaceVoxels face_voxels;
  ExportSticks sticks;
  ExportPackage package;
};

console::Output run(const Options& options, const console::Console& console) {
  options.package.check();
  if (!options.faces.asked() && !options.face_voxels.asked() && !options.volumes.asked() &&
      !options.sticks.asked() && !options.package.asked()) {
    throw Error(ErrorCode::kUsage, "nothing to export",
                "name a file with --raw, --nrrd, --segy, --vti, --vtp, --tsurf, --csv, --face-voxels or "
                "--sticks, or a folder with "
                "--for petrel --out FOLDER");
  }
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output{{{"files", console::Json::array()}, {"renamed", console::Json::array()}}, ""};
  if (options.volumes.asked()) options.volumes.run(project, options.choice, console, output);
  if (options.faces.asked()) options.faces.run(project, options.choice, output);
  if (options.face_voxels.asked()) options.face_voxels.run(project, options.choice, console, output);
  if (options.sticks.asked()) options.sticks.run(project, options.choice, output);
  if (options.package.asked()) options.package.run(project, options.choice, output);
  return output;
}

}  // namespace

void ExportChoice::add_to(CLI::App& command) {
  command.add_option("--fault", fault, "Only this fault (default: all)");
  command.add_option("--run", run, "Statistics of this run (default: the last)");
  command.add_option("--z-positive", z_positive, "Turn z: up or down, whatever the format's default")
      ->check(CLI::IsMember({"up", "down"}));
  command
      .add_option("--z-unit", z_unit, "Unit of the z written: ms or s, m or ft (default: the survey's unit)")
      ->check(CLI::IsMember({"ms", "s", "m", "ft"}));
}

void add_file(console::Output& output, const std::string& file) {
  output.json["files"].push_back(file);
  output.text += "written " + file + "\n";
}

void add_renamed(console::Output& output, const std::vector<std::string>& renamed) {
  for (const std::string& line : renamed) {
    output.json["renamed"].push_back(line);
    output.text += "renamed: " + line + "\n";
  }
}

void add_export(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "export", "Write volumes, faces and sticks in other programs' formats",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  options->volumes.add_to(*command);
  options->faces.add_to(*command);
  options->face_voxels.add_to(*command);
  options->sticks.add_to(*command);
  options->package.add_to(*command);
  options->choice.add_to(*command);
}

}  // namespace footwall::commands
