#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_bench_balance(console::Program& program, CLI::App* bench);

}  // namespace footwall::commands
