// The isosurface of a volume on all ranks: each extracts the cells of its own pillars, and all learn how the
// triangles are numbered in the whole.
// Based on: seed 000, section 4; differs in that a pillar is read in blocks, and only where the min/max
// pyramid says that there is something to find.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/extract.h"
#include "engine/isosurface/parallel/piece.h"
#include "engine/isosurface/parallel/pillars.h"
#include "storage/base/job_context.h"

namespace footwall::isosurface {

// The samples of a box, or of more around it, in memory until the next call. Holds no communication. A volume
// that is in memory returns all of it each time; StoredSamples (stored_samples.h) reads the box from the
// file.
using FieldOf = std::function<Field(const survey::Box& samples)>;

struct ParallelOptions {
  // The kernel: `extract`, or a row of registry.h.
  void (*kernel)(const Field&, float, const ExtractOptions&, Surface&) = &extract;
  bool normals = true;
  bool keys = false;               // needed by weld() (weld.h)
  bool cap = false;                // closes the surface at the volume's border (cap.h); needs keys
  int threads = 1;                 // of each rank
  const Bricks* bricks = nullptr;  // of the whole volume, or none: every cell is looked at
  // Whether the kernel is told of them, too; kernels other than `extract` refuse that.
  bool kernel_skips = true;
  // Whether pillars are cut around bricks that may be active, so that the others are not read. A volume in
  // memory is quicker in one piece.
  bool cuts_around_bricks = true;
  std::int64_t block_cells = std::int64_t{1} << 24;  // that are read at once: 64 MiB
};

// What this rank has, and what it did for it.
struct Extraction {
  // One for each block that was looked at; blocks above each other ascend by sample.
  std::vector<Piece> pieces;
  std::uint64_t triangles = 0;    // of all ranks, caps included
  std::int64_t samples_read = 0;  // by this rank, those between blocks as often as they were read
  double read_seconds = 0;        // in FieldOf
  double busy_seconds = 0;  // processor time in the kernel: ranks that share a core are no busier for it
};

// Collective; the same Error on all ranks (AgreedError): what FieldOf and the kernel throw on any of them,
// kCancelled, looked at between blocks. Progress is that of this rank. `into` keeps its room: a second
// isovalue of the same volume touches no new memory where it has no more triangles. Memory: one block, and
// the triangles.
void extract_parallel(const comm::Communicator& world, const Pillars& pillars, const FieldOf& field_of,
                      float isovalue, const ParallelOptions& options, const JobContext& job,
                      Extraction& into);

// How much of the time the ranks wait for the slowest: 1 - mean / max; 0 where none was busy. Collective.
double load_imbalance(const comm::Communicator& world, double busy_seconds);

}  // namespace footwall::isosurface
