// footwall import volume|sticks: files into a project.
#include <fmt/format.h>
#include <algorithm>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/import_sticks.h"
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
        tasks::segy_source(options.file, options.volume.segy(), console.job().part(0, 0.1));
    source = std::move(import.source);
    warnings = import.report.warnings;
  } else {
    throw Error(ErrorCode::kFormat, options.file + " does not look like SEG-Y",
                "for raw float32 samples add --raw and --dims");
  }
  const project::VolumeRecord volume = tasks::add_volume(project, name, source, console.job().part(0.1, 1));
  for (const std::string& warning : warnings) log::warn(warning);
  console::Output output = volume_output(volume, source.geometry);
  output.json["warnings"] = warnings;
  project.close();
  return output;
}

struct SticksImport {
  std::string project, file, format;
  bool z_up = false;
};

console::Json rejected_json(const formats::ImportReport& report) {
  console::Json rows = console::Json::array();
  for (const formats::RejectedRow& row : report.rejected) {
    rows.push_back({{"line", row.line}, {"column", row.column}, {"reason", row.reason}});
  }
  return rows;
}

console::Output import_sticks(const SticksImport& options) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::SticksImported done =
      tasks::import_sticks(project, options.file, options.format, {options.z_up});
  project.close();
  const formats::ImportReport& report = done.report;
  console::Output output;
  output.json = {
      {"read", report.read},       {"skipped", report.skipped}, {"rejected", rejected_json(report)},
      {"assumed", report.assumed}, {"renamed", report.renamed}, {"faults", done.faults},
      {"pillars", done.pillars},   {"notices", done.notices}};
  output.text =
      fmt::format("{} points on {} pillars of {} faults; {} rows skipped, {} rejected\n", report.read,
                  done.pillars, done.faults.size(), report.skipped, report.rejected_count);
  constexpr std::size_t kShown = 20;
  for (std::size_t n = 0; n < std::min(report.rejected.size(), kShown); ++n) {
    const formats::RejectedRow& row = report.rejected[n];
    output.text += fmt::format("rejected: line {}, column {}: {}\n", row.line, row.column, row.reason);
  }
  if (report.rejected_count > static_cast<std::int64_t>(kShown))
    output.text += "... --json lists the first 1000\n";
  for (const std::string& line : report.assumed) output.text += "assumed: " + line + "\n";
  for (const std::string& line : report.renamed) output.text += "renamed: " + line + "\n";
  for (const std::string& line : done.notices) log::warn(line);
  return output;
}

}  // namespace

void add_import(console::Program& program) {
  CLI::App* group = program.add_group("import", "Bring volumes and fault sticks into a project");

  auto volume = std::make_shared<VolumeImport>();
  CLI::App* command =
      program.add(group, "volume", "Import a SEG-Y or raw float32 volume",
                  [volume](console::Console& console) { return import_volume(*volume, console); });
  command->add_option("project", volume->project, "The project, NAME.footwall")->required();
  command->add_option("file", volume->file, "The file to import")->required();
  command->add_flag("--raw", volume->raw, "The file is raw little-endian float32 (needs --dims)");
  command->add_option("--name", volume->name, "Name of the volume (default: the file's name)");
  volume->volume.add_to(*command);

  auto sticks = std::make_shared<SticksImport>();
  command = program.add(group, "sticks", "Import fault sticks",
                        [sticks](console::Console&) { return import_sticks(*sticks); });
  command->add_option("project", sticks->project, "The project, NAME.footwall")->required();
  command->add_option("file", sticks->file, "The file to import")->required();
  command->add_option("--format", sticks->format, "charisma (default: told from the content)");
  command->add_flag("--z-up", sticks->z_up, "The file's z is elevation, positive up");
}

}  // namespace footwall::commands
