// footwall: the command line. One file per command in commands/; the work is done in engine/tasks.
#include "app/footwall/commands/commands.h"

int main(int argc, char** argv) {
  namespace commands = footwall::commands;
  footwall::console::Program program("footwall", "Fault interpretation workbench for 3D seismic data",
                                     "footwall 0.1.0");
  for (const auto add : {commands::add_new,         commands::add_import,      commands::add_info,
                         commands::add_faults,      commands::add_edit,        commands::add_history,
                         commands::add_interpolate, commands::add_triangulate, commands::add_extract,
                         commands::add_batch,       commands::add_attach,      commands::add_attribute,
                         commands::add_faces,       commands::add_compare,     commands::add_isosurface,
                         commands::add_export,      commands::add_render,      commands::add_set_statistic,
                         commands::add_views,       commands::add_pack,        commands::add_relink,
                         commands::add_doctor,      commands::add_workload,    commands::add_bench,
                         commands::add_serve,       commands::add_status,      commands::add_stop}) {
    add(program);
  }
  return program.run(argc, argv);
}
