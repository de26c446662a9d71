#include "engine/isosurface/parallel/extract_parallel.h"

#include <mpi.h>
#include <omp.h>
#include <time.h>

#include <algorithm>

#include "engine/isosurface/cap.h"
#include "engine/isosurface/parallel/active_blocks.h"
#include "engine/isosurface/parallel/detail/stretches.h"

namespace footwall::isosurface {
namespace {

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// Blocks of one pillar in the order of the triangles in its rows: those above each other ascend by sample.
std::vector<survey::Box> blocks_of_rank(const Pillars& pillars, int rank, const ParallelOptions& options,
                                        float isovalue) {
  const Bricks* const around = options.cuts_around_bricks ? options.bricks : nullptr;
  const Wanted wanted{around, isovalue, options.cap, options.block_cells};
  std::vector<survey::Box> blocks;
  for (const survey::Box& cells : pillars.of_rank(rank)) {
    const std::vector<survey::Box> some = active_blocks(cells, wanted);
    blocks.insert(blocks.end(), some.begin(), some.end());
  }
  return blocks;
}

// Closes a block's surface where the block reaches the volume's border. A cap is made from just the samples
// of the cells, without those around them that gradients need.
void cap_block(const Field& field, const Pillars& pillars, const survey::Box& cells, float isovalue,
               Surface& surface) {
  const survey::Box samples = pillars.samples_of(cells, false);
  bool at_border = false;
  for (int axis = 0; axis < 3; ++axis)
    at_border = at_border || samples.lo[axis] == 0 || samples.hi[axis] == pillars.volume()[axis];
  if (!at_border) return;
  std::vector<float> values(static_cast<std::size_t>(samples.count()));
  float* to = values.data();
  for (std::int64_t i = samples.lo[0]; i < samples.hi[0]; ++i) {
    for (std::int64_t j = samples.lo[1]; j < samples.hi[1]; ++j) {
      const std::int64_t row = (i - field.origin[0]) * field.size[1] + j - field.origin[1];
      const float* const from = field.values.data() + row * field.size[2] + samples.lo[2] - field.origin[2];
      to = std::copy_n(from, samples.size(2), to);
    }
  }
  const Field inner{
      values, {samples.size(0), samples.size(1), samples.size(2)}, samples.lo, pillars.volume()};
  cap(inner, isovalue, surface);
}

void extract_block(const survey::Box& cells, const Pillars& pillars, const FieldOf& field_of, float isovalue,
                   const ParallelOptions& options, Extraction& into, Surface& surface) {
  const survey::Box samples = pillars.samples_of(cells, options.normals);
  const double start = omp_get_wtime();
  const Field field = field_of(samples);
  into.read_seconds += omp_get_wtime() - start;
  const double busy = processor_seconds();
  ExtractOptions how;
  how.normals = options.normals;
  how.keys = options.keys;
  how.threads = options.threads;
  how.cells = cells;
  if (options.kernel_skips) how.bricks = options.bricks;
  options.kernel(field, isovalue, how, surface);
  if (options.cap) cap_block(field, pillars, cells, isovalue, surface);
  into.samples_read += samples.count();
  into.busy_seconds += processor_seconds() - busy;
}

}  // namespace

void extract_parallel(const comm::Communicator& world, const Pillars& pillars, const FieldOf& field_of,
                      float isovalue, const ParallelOptions& options, const JobContext& job,
                      Extraction& into) {
  std::vector<detail::Stretch> stretches;
  std::vector<Run> runs;
  // 1. Each rank the blocks of its pillars.
  world.collectively([&] {
    require(world.size() == pillars.ranks(), "the pillars are those of these ranks");
    require(!options.cap || options.keys, "a capped surface has keys");
    into.triangles = 0;
    into.samples_read = 0;
    into.read_seconds = 0;
    into.busy_seconds = 0;
    const std::vector<survey::Box> blocks = blocks_of_rank(pillars, world.rank(), options, isovalue);
    into.pieces.resize(blocks.size());
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      job.report(static_cast<double>(n) / static_cast<double>(blocks.size()), "extract");
      extract_block(blocks[n], pillars, field_of, isovalue, options, into, into.pieces[n].surface);
    }
    job.report(1, "extract");
    stretches = detail::stretches_of(pillars, into.pieces);
    runs.reserve(stretches.size());
    for (const detail::Stretch& stretch : stretches) runs.push_back(stretch.run);
  });
  // 2. All of them the numbers of the rows' first triangles.
  into.triangles = number_runs(world, detail::triangle_slots(pillars), runs);
  world.collectively([&] {
    for (Piece& piece : into.pieces) {
      const survey::Box& cells = piece.surface.cells;
      piece.row_numbers.assign(static_cast<std::size_t>(cells.size(0) * cells.size(1)), 0);
    }
    for (std::size_t n = 0; n < runs.size(); ++n) {
      if (stretches[n].row != detail::kNoRow)
        into.pieces[stretches[n].piece].row_numbers[stretches[n].row] = runs[n].first;
    }
  });
}

double load_imbalance(const comm::Communicator& world, double busy_seconds) {
  double sum = 0;
  comm::check(MPI_Allreduce(&busy_seconds, &sum, 1, MPI_DOUBLE, MPI_SUM, world.get()), "MPI_Allreduce");
  const double most = world.maximum(busy_seconds);
  return most > 0 ? 1 - sum / world.size() / most : 0;
}

}  // namespace footwall::isosurface
