// footwall workload make: writes a script of random meshes that grow, move and go.
#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/footwall/commands/options.h"
#include "app/footwall/commands/workload.h"
#include "engine/tasks/workload/make.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string size, file;
  tasks::WorkloadShape shape;
};

console::Output make(Options& options, const console::Console& console) {
  tasks::WorkloadShape& shape = options.shape;
  shape.size = dims_from(options.size, "size");
  const tasks::MadeWorkload made = tasks::make_workload(shape, options.file, console.job());
  const double off = std::abs(made.mean_area - shape.area) / shape.area;
  if (off > tasks::kAreaTolerance) {
    log::warn(fmt::format("the mean area is {:.4g} voxel^2, not {:.4g}: ask for {:.4g} instead",
                          made.mean_area, shape.area, shape.area * shape.area / made.mean_area));
  }
  if (made.faces_outside > 0) {
    log::warn(fmt::format("{} of {} faces do not lie wholly inside the survey: it is small for them",
                          made.faces_outside, made.faces));
  }
  const tasks::OperationCounts& counts = made.operations;
  console::Output output;
  output.json = {{"file", options.file},
                 {"size", shape.size},
                 {"meshes", shape.meshes},
                 {"repeats", shape.repeats},
                 {"cycles", shape.cycles},
                 {"seed", shape.seed},
                 {"area", shape.area},
                 {"mean_area", made.mean_area},
                 {"mean_area_extracted", made.mean_area_extracted},
                 {"faces", made.faces},
                 {"faces_outside", made.faces_outside},
                 {"operations",
                  {{"adds", counts.adds()},
                   {"removes", counts.remove_faces},
                   {"moves", counts.move_vertex},
                   {"extracts", counts.extract_all},
                   {"create_mesh", counts.create_mesh},
                   {"destroy_mesh", counts.destroy_mesh}}}};
  output.text = fmt::format(
      "{}: {} repeats of {} meshes with {} faces\n"
      "mean area {:.2f} voxel^2 when made, {:.2f} when extracted\n"
      "{} adds, {} removes, {} moves, {} EXTRACT-ALLs\n",
      options.file, shape.repeats, shape.meshes, shape.faces + shape.meshes, made.mean_area,
      made.mean_area_extracted, counts.adds(), counts.remove_faces, counts.move_vertex, counts.extract_all);
  return output;
}

}  // namespace

void add_workload_make(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "make", "Write a script: random meshes grow, are extracted, move and go",
                  [options](console::Console& console) { return make(*options, console); });
  tasks::WorkloadShape& shape = options->shape;
  command->add_option("size", options->size, "The survey, INLINESxCROSSLINESxSAMPLES voxels")->required();
  command->add_option("area", shape.area, "Mean area of a face when it is made, in voxels^2")->required();
  command->add_option("faces", shape.faces, "ADD-FACEs of a repeat; each mesh has one face more")->required();
  command->add_option("cycles", shape.cycles, "EXTRACT-ALLs of a repeat")->required();
  command->add_option("distance", shape.distance, "Mean length of a vertex's move, in voxels")->required();
  command->add_option("repeats", shape.repeats, "Repeats, each with other meshes")->required();
  command->add_option("file", options->file, "The script to write")->required();
  command->add_option("--meshes", shape.meshes, "Meshes of a repeat (default 16)");
  command->add_option("--seed", shape.seed, "Another seed gives other meshes and moves (default 1)");
  command->add_option("--move-fraction", shape.move_fraction,
                      "Part of the vertices that moves before an EXTRACT-ALL, 0 to 1 (default 1)");
  command->add_flag("--move-first", shape.move_first,
                    "Vertices move before the first EXTRACT-ALL, too (default: before each but the first)");
}

}  // namespace footwall::commands
