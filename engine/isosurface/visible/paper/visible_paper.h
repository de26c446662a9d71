// Mode `paper`: only what can be seen of an isosurface, as it was published, with data on every rank and the
// tests of visibility on rank 0. It may lose what is seen (visibility_mask.h); mode `depth` does not.
// Based on: seed 003; differs as told in the headers of its steps: screen_box.h, visibility_mask.h,
// workload.h, partition.h, merge_masks.h, engine/render/coverage_mask.h.
#pragma once
#include <functional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/field.h"
#include "engine/isosurface/visible/octree.h"
#include "engine/isosurface/visible/paper/extract_cells.h"
#include "engine/isosurface/visible/passes.h"
#include "storage/base/job_context.h"

namespace footwall::isosurface {

// The cells of the octree that are used where none are asked for: about 32 of them along each axis, as with
// the paper's data sets, 8 cells of the lattice at least, in whole bricks.
survey::Index default_paper_cell(const survey::Index& volume_size);
inline constexpr survey::Index kDefaultEstimateCell{1, 1, 1};

// The octree over leaves of `cell` cells of a volume whose bricks are known; reads samples only where the
// cell is not made of whole bricks. Throws as leaf_ranges() and Octree do.
Octree paper_octree(const Field& volume, const Bricks& bricks, const survey::Index& cell, int threads);

struct VisiblePieces {
  std::vector<SomeTriangles> passes;  // one for each pass in which this rank got cells
  VisibleReport report;               // of all ranks, on rank 0; elsewhere it tells nothing
  // Rank 0: processor time of each pass, which is no more where ranks share a core.
  struct Busy {
    double host = 0;     // rank 0's, in visibility and partition
    double extract = 0;  // the slowest rank's
  };
  std::vector<Busy> busy_seconds;
};

// Collective; the same Error on all ranks: kUsage for a picture, cell or estimate cell that cannot be,
// kInvalid for a volume that is not whole, kCancelled (looked at in each pass), kMemory. volume: the same on
// every rank. octree: of request.cell on rank 0, nullptr elsewhere. after_pass (may be empty): called on
// every rank when a pass is done, with what there is so far; collective calls are allowed in it, and its time
// is not counted. The number of triangles of each pass does not depend on the number of ranks, nor do the
// passes. `into` keeps its room.
void extract_visible_paper(comm::Communicator& world, const Field& volume, const Octree* octree,
                           const VisibleRequest& request, const JobContext& job,
                           const std::function<void(const VisiblePieces&)>& after_pass, VisiblePieces& into);

}  // namespace footwall::isosurface
