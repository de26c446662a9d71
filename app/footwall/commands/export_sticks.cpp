// footwall export: pillars as fault sticks.
#include <fmt/format.h>

#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/export_sticks.h"
#include "storage/formats/stick_formats.h"

namespace footwall::commands {

void ExportSticks::add_to(CLI::App& command) {
  command.add_option("--sticks", sticks, "Picked and snapped pillars as fault sticks (z positive down)");
  std::string formats;
  for (const formats::StickFormat& known : formats::stick_formats()) {
    if (known.write != nullptr) formats += (formats.empty() ? "" : ", ") + std::string(known.name);
  }
  command.add_option("--stick-format", format, "--sticks: " + formats)->capture_default_str();
  command.add_flag("--interpolated", interpolated, "--sticks: interpolated pillars too");
  command.add_flag("--no-blanks", no_blanks, "--sticks: blanks in names become '_'");
}

void ExportSticks::run(const project::Project& project, const ExportChoice& choice,
                       console::Output& output) const {
  tasks::SticksChoice chosen;
  chosen.fault = choice.fault;
  chosen.interpolated = interpolated;
  chosen.z_positive_up = choice.z_up(false);
  chosen.z_unit = choice.z_unit;
  chosen.names_without_blanks = no_blanks;
  const tasks::SticksExported done = tasks::export_sticks(project, sticks, format, chosen);
  output.json["files"].push_back(sticks);
  output.json["sticks"] = {{"format", format},
                           {"faults", done.faults},
                           {"pillars", done.pillars},
                           {"nodes", done.nodes},
                           {"renamed", done.renamed}};
  output.text += fmt::format("written {}: {} nodes on {} pillars of {} faults\n", sticks, done.nodes,
                             done.pillars, done.faults);
  for (const std::string& line : done.renamed) output.text += "renamed: " + line + "\n";
}

}  // namespace footwall::commands
