// footwall import volume|sticks|surface: files into a project.
#include "app/footwall/commands/import.h"

#include <fmt/format.h>
#include <algorithm>

#include "app/footwall/commands/commands.h"

namespace footwall::commands {

console::Json report_json(const formats::ImportReport& report) {
  console::Json rows = console::Json::array();
  for (const formats::RejectedRow& row : report.rejected) {
    rows.push_back({{"line", row.line}, {"column", row.column}, {"reason", row.reason}});
  }
  return {{"read", report.read},
          {"skipped", report.skipped},
          {"rejected", rows},
          {"assumed", report.assumed},
          {"renamed", report.renamed}};
}

std::string report_text(const formats::ImportReport& report) {
  constexpr std::size_t kShown = 20;
  std::string text;
  for (std::size_t n = 0; n < std::min(report.rejected.size(), kShown); ++n) {
    const formats::RejectedRow& row = report.rejected[n];
    text += fmt::format("rejected: line {}, column {}: {}\n", row.line, row.column, row.reason);
  }
  if (report.rejected_count > static_cast<std::int64_t>(kShown)) text += "... --json lists the first 1000\n";
  for (const std::string& line : report.assumed) text += "assumed: " + line + "\n";
  for (const std::string& line : report.renamed) text += "renamed: " + line + "\n";
  return text;
}

void add_import(console::Program& program) {
  CLI::App* group = program.add_group("import", "Bring volumes, fault sticks and surfaces into a project");
  add_import_volume(program, group);
  add_import_sticks(program, group);
  add_import_surface(program, group);
}

}  // namespace footwall::commands
