// footwall import sticks: fault sticks into a project.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/import_sticks.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct SticksImport {
  std::string project, file, format;
  bool z_up = false;
};

console::Output import_sticks(const SticksImport& options) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  formats::SticksOptions how;
  if (options.z_up) how.z_positive_up = true;
  const tasks::SticksImported done = tasks::import_sticks(project, options.file, options.format, how);
  project.close();
  console::Output output;
  output.json = report_json(done.report);
  output.json["faults"] = done.faults;
  output.json["pillars"] = done.pillars;
  output.json["notices"] = done.notices;
  output.text =
      fmt::format("{} points on {} pillars of {} faults; {} rows skipped, {} rejected\n", done.report.read,
                  done.pillars, done.faults.size(), done.report.skipped, done.report.rejected_count) +
      report_text(done.report);
  for (const std::string& line : done.notices) log::warn(line);
  return output;
}

}  // namespace

void add_import_sticks(console::Program& program, CLI::App* group) {
  auto sticks = std::make_shared<SticksImport>();
  CLI::App* command = program.add(group, "sticks", "Import fault sticks",
                                  [sticks](console::Console&) { return import_sticks(*sticks); });
  command->add_option("project", sticks->project, "The project, NAME.footwall")->required();
  command->add_option("file", sticks->file, "The file to import")->required();
  command->add_option("--format", sticks->format, "charisma (default: told from the content)");
  command->add_flag("--z-up", sticks->z_up, "The file's z is elevation, positive up");
}

}  // namespace footwall::commands
