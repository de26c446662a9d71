// footwall import volume: SEG-Y, NRRD and raw volumes into a project.
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/volume_input.h"

namespace footwall::commands {
namespace {

struct VolumeImport {
  std::string project, file, name;
  bool raw = false;
  VolumeOptions volume;
  ShapeOptions shape;
};

console::Output import_volume(const VolumeImport& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const std::string name =
      options.name.empty() ? std::filesystem::path(options.file).stem().string() : options.name;
  const VolumeKind kind = options.raw ? VolumeKind::kRaw : VolumeKind::kTold;
  const double headers = share_of_headers(kind);
  const VolumeInput input = volume_input(options.file, kind, options.volume, options.shape, project.survey(),
                                         project.path().parent_path(), console.job().part(0, headers));
  const project::VolumeRecord volume =
      tasks::add_volume(project, name, input.source, console.job().part(headers, 1));
  console::Output output = volume_output(volume, input);
  project.close();
  return output;
}

}  // namespace

void add_import_volume(console::Program& program, CLI::App* group) {
  auto volume = std::make_shared<VolumeImport>();
  CLI::App* command =
      program.add(group, "volume", "Import a SEG-Y, NRRD or raw float32 volume",
                  [volume](console::Console& console) { return import_volume(*volume, console); });
  command->add_option("project", volume->project, "The project, NAME.footwall")->required();
  command->add_option("file", volume->file, "The file to import")->required();
  command->add_flag("--raw", volume->raw, "The file is raw float32 (needs --dims)");
  command->add_option("--name", volume->name, "Name of the volume (default: the file's name)");
  volume->volume.add_to(*command);
  volume->shape.add_to(*command);
}

}  // namespace footwall::commands
