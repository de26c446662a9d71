// A part of `footwall bench`, in the file of its name.
#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_bench_extract(console::Program& program, CLI::App* group);

}  // namespace footwall::commands
