// footwall workload make|run: scripted move-extract workloads, as the seed's genscript and cpfw.
#include "app/footwall/commands/workload.h"

#include "app/footwall/commands/commands.h"

namespace footwall::commands {

void add_workload(console::Program& program) {
  CLI::App* group = program.add_group("workload", "Scripted workloads of mesh operations and EXTRACT-ALLs");
  add_workload_make(program, group);
  add_workload_run(program, group);
}

}  // namespace footwall::commands
