// The parts of `footwall import`, each in the file of its name, and what their reports have in common.
#pragma once
#include <string>

#include "app/footwall/console/program.h"
#include "storage/formats/import_report.h"

namespace footwall::commands {

void add_import_volume(console::Program& program, CLI::App* group);
void add_import_sticks(console::Program& program, CLI::App* group);
void add_import_surface(console::Program& program, CLI::App* group);

// {read, skipped, rejected[{line,column,reason}], assumed[], renamed[]}
console::Json report_json(const formats::ImportReport& report);
// The first rejected rows and everything assumed and renamed, a line each.
std::string report_text(const formats::ImportReport& report);

}  // namespace footwall::commands
