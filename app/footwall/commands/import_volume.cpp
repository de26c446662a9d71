// footwall import volume: SEG-Y and raw volumes into a project.
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/options.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct VolumeImport {
  std::string project, file, name;
  bool raw = false;
  VolumeOptions volume;
};

console::Output import_volume(const VolumeImport& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const std::string name =
      options.name.empty() ? std::filesystem::path(options.file).stem().string() : options.name;
  tasks::VolumeSource source;
  std::vector<std::string> warnings;
  if (options.raw) {
    const auto survey = project.survey();
    source = tasks::raw_source(options.file, options.volume.raw(),
                               survey ? *survey : options.volume.raw_geometry());
  } else if (formats::segy::looks_like_segy(options.file)) {
    tasks::SegyImport import =
        tasks::segy_source(options.file, options.volume.segy(), console.job().part(0, 0.4));
    source = std::move(import.source);
    warnings = import.report.warnings;
  } else {
    throw Error(ErrorCode::kFormat, options.file + " does not look like SEG-Y",
                "for raw float32 samples add --raw and --dims");
  }
  const project::VolumeRecord volume = tasks::add_volume(project, name, source, console.job().part(0.4, 1));
  for (const std::string& warning : warnings) log::warn(warning);
  console::Output output = volume_output(volume, source.geometry);
  output.json["warnings"] = warnings;
  project.close();
  return output;
}

}  // namespace

void add_import_volume(console::Program& program, CLI::App* group) {
  auto volume = std::make_shared<VolumeImport>();
  CLI::App* command =
      program.add(group, "volume", "Import a SEG-Y or raw float32 volume",
                  [volume](console::Console& console) { return import_volume(*volume, console); });
  command->add_option("project", volume->project, "The project, NAME.footwall")->required();
  command->add_option("file", volume->file, "The file to import")->required();
  command->add_flag("--raw", volume->raw, "The file is raw little-endian float32 (needs --dims)");
  command->add_option("--name", volume->name, "Name of the volume (default: the file's name)");
  volume->volume.add_to(*command);
}

}  // namespace footwall::commands
