// footwall import sticks: fault sticks into a project.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/import.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/import_sticks.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/formats/columns.h"
#include "storage/formats/stick_formats.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, file, format, fault, z_positive, z_unit, columns, delimiter, layout;
  int header_rows = 0;
  bool z_up = false, preview = false;

  formats::SticksOptions how() const {
    formats::SticksOptions how;
    if (z_up || !z_positive.empty()) how.z_positive_up = z_up || z_positive == "up";
    how.z_unit = z_unit;
    how.fault = fault;
    if (!columns.empty()) {
      how.columns = formats::columns::map_from(columns);
      how.columns->header_rows = header_rows;
      how.columns->delimiter = delimiter.empty() ? '\0' : formats::columns::delimiter_from(delimiter);
    }
    constexpr std::size_t kLayoutLimit = std::size_t{1} << 20;
    if (!layout.empty()) how.layout = read_whole_file(layout, kLayoutLimit);
    return how;
  }
};

console::Output report(const tasks::SticksImported& done, std::string_view what) {
  console::Output output;
  output.json = report_json(done.report);
  output.json["format"] = done.format;
  output.json["faults"] = done.faults;
  output.json["pillars"] = done.pillars;
  output.json["notices"] = done.notices;
  output.text = fmt::format("{}{} points on {} pillars of {} faults ({}); {} rows skipped, {} rejected\n",
                            what, done.report.read, done.pillars, done.faults.size(), done.format,
                            done.report.skipped, done.report.rejected_count) +
                report_text(done.report);
  for (const std::string& line : done.notices) log::warn(line);
  return output;
}

console::Output preview_sticks(const Options& options) {
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  const tasks::SticksPreview preview =
      tasks::preview_sticks(project, options.file, options.format, options.how());
  console::Output output = report(preview.counts, "would import ");
  output.json["rows"] = console::Json::array();
  output.text += fmt::format("\n{:>14} {:>14} {:>12} {:>6}  {}\n", "x", "y", "z", "stick", "fault");
  for (const auto& [fault, stick, point] : preview.rows) {
    output.json["rows"].push_back(
        {{"fault", fault}, {"stick", stick}, {"x", point.x}, {"y", point.y}, {"z", point.z}});
    output.text +=
        fmt::format("{:>14.4f} {:>14.4f} {:>12.4f} {:>6}  {}\n", point.x, point.y, point.z, stick, fault);
  }
  return output;
}

console::Output import_sticks(const Options& options, const console::Console& console) {
  if (options.preview) return preview_sticks(options);
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::SticksImported done =
      tasks::import_sticks(project, options.file, options.format, options.how(), console.job());
  project.close();
  return report(done, "");
}

}  // namespace

void add_import_sticks(console::Program& program, CLI::App* group) {
  auto sticks = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "sticks", "Import fault sticks",
                  [sticks](console::Console& console) { return import_sticks(*sticks, console); });
  std::string formats;
  for (const formats::StickFormat& format : formats::stick_formats())
    formats += std::string(format.name) + ", ";
  command->add_option("project", sticks->project, "The project, NAME.footwall")->required();
  command->add_option("file", sticks->file, "The file to import")->required();
  command->add_option("--format", sticks->format, formats + "or told from the content (default)");
  command->add_option("--fault", sticks->fault,
                      "Name of the fault where the file has none (default: the file's)");
  CLI::Option* z_positive =
      command
          ->add_option("--z-positive", sticks->z_positive,
                       "Where the file's z is positive: up or down (default: as it says, or down)")
          ->check(CLI::IsMember({"up", "down"}));
  command->add_flag("--z-up", sticks->z_up, "The same as --z-positive up")->excludes(z_positive);
  command
      ->add_option("--z-unit", sticks->z_unit,
                   "Unit of the file's z: ms or s, m or ft (default: as it says, or the survey's)")
      ->check(CLI::IsMember({"ms", "s", "m", "ft"}));
  CLI::Option* columns = command->add_option(
      "--columns", sticks->columns,
      "Read a table: columns from 1, as in name=6,x=3,y=4,z=5,stick=7; also node, inline, crossline");
  command->add_option("--header-rows", sticks->header_rows, "--columns: rows above the table")
      ->check(CLI::Range(0, 1000000))
      ->needs(columns);
  command
      ->add_option("--delimiter", sticks->delimiter,
                   "--columns: comma, semicolon, tab, blank or a character (default: told from the content)")
      ->needs(columns);
  command->add_option("--layout", sticks->layout,
                      "The format file that says where a column file has its fields");
  command->add_flag("--preview", sticks->preview, "Show what would be imported, change nothing");
}

}  // namespace footwall::commands
