// The parts of `footwall workload`, each in the file of its name.
#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_workload_make(console::Program& program, CLI::App* group);
void add_workload_run(console::Program& program, CLI::App* group);

}  // namespace footwall::commands
