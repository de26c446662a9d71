// footwall bench: figures that check their answer before they count the time.
#include "app/footwall/commands/bench_balance.h"
#include "app/footwall/commands/bench_extract.h"
#include "app/footwall/commands/bench_isosurface.h"
#include "app/footwall/commands/bench_quality.h"
#include "app/footwall/commands/bench_render.h"
#include "app/footwall/commands/bench_service.h"
#include "app/footwall/commands/bench_topology.h"
#include "app/footwall/commands/bench_visible.h"
#include "app/footwall/commands/commands.h"

namespace footwall::commands {

void add_bench(console::Program& program) {
  CLI::App* group = program.add_group("bench", "Measure, after checking the answer");
  add_bench_balance(program, group);
  add_bench_extract(program, group);
  add_bench_isosurface(program, group);
  add_bench_quality(program, group);
  add_bench_render(program, group);
  add_bench_service(program, group);
  add_bench_topology(program, group);
  add_bench_visible(program, group);
  add_bench_voxelize(program, group);
}

}  // namespace footwall::commands
