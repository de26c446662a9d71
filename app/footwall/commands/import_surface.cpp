// footwall import surface: a GOCAD TSurf as a ready mesh.
#include "engine/tasks/import_surface.h"

#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/options.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct SurfaceImport {
  std::string project, file, name, z_positive, z_unit;
};

console::Output import_surface(const SurfaceImport& options, const console::Console& console) {
  tasks::SurfaceImportOptions how;
  how.name = options.name;
  if (!options.name.empty()) project::check_name("fault", options.name);
  if (!options.z_positive.empty()) how.z_positive_up = options.z_positive == "up";
  how.z_unit = options.z_unit;
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::SurfacesImported done = tasks::import_surface(project, options.file, how, console.job());
  project.close();
  console::Output output;
  output.json = report_json(done.report);
  output.json["faults"] = console::Json::array();
  output.json["notices"] = done.notices;
  for (const tasks::ImportedSurface& fault : done.faults) {
    output.json["faults"].push_back(
        {{"name", fault.fault}, {"vertices", fault.vertices}, {"triangles", fault.triangles}});
    output.text +=
        fmt::format("fault {}: {} vertices, {} triangles\n", fault.fault, fault.vertices, fault.triangles);
  }
  output.text += fmt::format("{} rows read, {} skipped, {} rejected\n", done.report.read, done.report.skipped,
                             done.report.rejected_count) +
                 report_text(done.report);
  for (const std::string& line : done.notices) log::warn(line);
  return output;
}

}  // namespace

void add_import_surface(console::Program& program, CLI::App* group) {
  auto surface = std::make_shared<SurfaceImport>();
  CLI::App* command =
      program.add(group, "surface", "Import a GOCAD TSurf as faults with a ready mesh",
                  [surface](console::Console& console) { return import_surface(*surface, console); });
  command->add_option("project", surface->project, "The project, NAME.footwall")->required();
  command->add_option("file", surface->file, "The file to import")->required();
  command->add_option("--name", surface->name, "Name of the fault (default: as in the file)");
  command
      ->add_option("--z-positive", surface->z_positive,
                   "The file's z grows up or down (default: its ZPOSITIVE, else up)")
      ->check(CLI::IsMember({"up", "down"}));
  command->add_option("--z-unit", surface->z_unit, "Unit of the file's z (default: its AXIS_UNIT)")
      ->check(CLI::IsMember({"ms", "s", "m", "ft"}));
}

}  // namespace footwall::commands
