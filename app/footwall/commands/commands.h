// One function per command, each in the file of its name.
#pragma once
#include "app/footwall/console/program.h"

namespace footwall::commands {

void add_attach(console::Program& program);
void add_attribute(console::Program& program);
void add_batch(console::Program& program);
void add_new(console::Program& program);
void add_import(console::Program& program);
void add_info(console::Program& program);
void add_faults(console::Program& program);
void add_edit(console::Program& program);
void add_history(console::Program& program);  // undo, redo, history
void add_interpolate(console::Program& program);
void add_set_statistic(console::Program& program);
void add_triangulate(console::Program& program);
void add_extract(console::Program& program);
void add_faces(console::Program& program);
void add_isosurface(console::Program& program);
void add_export(console::Program& program);
void add_render(console::Program& program);
void add_serve(console::Program& program);
void add_status(console::Program& program);
void add_stop(console::Program& program);
void add_views(console::Program& program);
void add_pack(console::Program& program);
void add_relink(console::Program& program);
void add_compare(console::Program& program);
void add_doctor(console::Program& program);
void add_workload(console::Program& program);  // workload make, workload run
void add_bench(console::Program& program);
void add_bench_voxelize(console::Program& program, CLI::App* group);

}  // namespace footwall::commands
