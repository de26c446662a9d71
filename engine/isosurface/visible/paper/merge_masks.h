// The coverage masks of all ranks, brought together on the host.
#pragma once
#include "engine/comm/communicator.h"
#include "engine/render/coverage_mask.h"

namespace footwall::isosurface {

// `mine` of rank 0 becomes the OR of all ranks' masks, which must be of the same picture; those of other
// ranks get some of the others' bits. Halves of the rows of tiles change hands in log2 steps, then each rank
// sends its part to rank 0; where ranks are no power of two, those beyond give theirs away first.
// Collective; every message is counted.
// Based on: seed 003, section 3.4.2; differs in that any number of ranks is possible.
void merge_masks(comm::Communicator& world, render::CoverageMask& mine);

}  // namespace footwall::isosurface
