// The compute phase of the strategies that move voxels: every face of this rank from its own blocks and the
// cache.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

// The faces that this rank is responsible for: those all of whose values are in one of its blocks from the
// start, and the others. Places in the input.
struct OwnFaces {
  std::vector<std::size_t> local;
  std::vector<std::size_t> crossing;
};
OwnFaces own_faces(const Setup& setup);

// Folds and computes the listed faces, whose voxels must all be in setup.blocks or setup.cache, and appends
// the results to `outcome` (finished, blobs, walked), in the order of `faces`. between: called now and then
// from the calling thread, to let messages move; may be empty. Not collective; throws as the computations do,
// kCancelled.
void compute_faces(const Setup& setup, std::span<const std::size_t> faces, Outcome& outcome,
                   const std::function<void()>& between = {});

}  // namespace footwall::extract
