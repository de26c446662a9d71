// footwall bench topology
#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_bench_topology(console::Program& program, CLI::App* group);

}  // namespace footwall::commands
