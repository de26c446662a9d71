// footwall import volume: SEG-Y, NRRD and raw volumes into a project.
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/volume_input.h"

namespace footwall::commands {
namespace {

struct VolumeImport {
  std::string project, file, name, role = "amplitude", high_is = "fault";
  bool raw = false;
  VolumeOptions volume;
  ShapeOptions shape;
};

// What the samples mean; both the file and the project keep it, the latter in the volume's provenance.
void give_role(const VolumeImport& options, tasks::VolumeSource& source) {
  source.role = volume::role_from(options.role);
  if (source.role != volume::Role::kDiscontinuity) {
    if (options.high_is != "fault")
      throw Error(ErrorCode::kUsage, "--high-is is about discontinuity volumes", "add --role discontinuity");
    return;
  }
  source.high_is_fault = options.high_is == "fault";
  console::Json provenance = console::Json::parse(source.provenance_json);
  provenance["high_is"] = options.high_is;
  source.provenance_json = provenance.dump();
}

console::Output import_volume(const VolumeImport& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const std::string name =
      options.name.empty() ? std::filesystem::path(options.file).stem().string() : options.name;
  const VolumeKind kind = options.raw ? VolumeKind::kRaw : VolumeKind::kTold;
  const double headers = share_of_headers(kind);
  VolumeInput input = volume_input(options.file, kind, options.volume, options.shape, project.survey(),
                                   project.path().parent_path(), console.job().part(0, headers));
  give_role(options, input.source);
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
  command
      ->add_option("--role", volume->role,
                   "What the samples are: amplitude (default), discontinuity or other")
      ->check(CLI::IsMember({"amplitude", "discontinuity", "other"}));
  command
      ->add_option("--high-is", volume->high_is,
                   "Of a discontinuity volume, what high values mean: fault (default) or continuous")
      ->check(CLI::IsMember({"fault", "continuous"}));
  volume->volume.add_to(*command);
  volume->shape.add_to(*command);
}

}  // namespace footwall::commands
