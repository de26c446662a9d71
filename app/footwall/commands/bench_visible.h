// footwall bench visible: what only the visible part of an isosurface costs, as the tables of seed 003.
#pragma once
#include <string>

#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_bench_visible(console::Program& program, CLI::App* group);

// The tables 1 to 6 and what figures 7 to 11 show, of {runs: [...]} (engine/tasks/visible_bench).
std::string visible_tables(const console::Json& result);

}  // namespace footwall::commands
