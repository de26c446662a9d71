#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_bench_service(console::Program& program, CLI::App* group);

}  // namespace footwall::commands
