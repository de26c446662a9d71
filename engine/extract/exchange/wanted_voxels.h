// Which voxels have to move: what a rank needs of others, and what others need of it. Every rank knows all
// faces, so that both ends of a pair find the same voxels without a word.
#pragma once
#include <span>
#include <vector>

#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

// By rank; nothing for the rank itself. Voxels that the receiving rank holds, in its halo too, are left out,
// those of its cache are not.
using ListPerRank = std::vector<BrickList>;

// By owner: the voxels that the given faces of this rank and their reach cut. `faces` are places in the
// input.
ListPerRank needed_from(const Setup& setup, std::span<const std::size_t> faces);
// By receiver: the voxels of this rank that needed_from() finds on the receiver for its faces.
ListPerRank needed_by(const Setup& setup);
// By receiver: the voxels of this rank in the bounding boxes of the receiver's faces, with their reach.
ListPerRank around_faces_of(const Setup& setup);

// The lists without what the receiver has from earlier, and the hits counted (of this rank's cache) or not
// (of what it sent).
void leave_out_cached(const Setup& setup, ListPerRank& needed);
void leave_out_sent(const Setup& setup, ListPerRank& wanted);

// For each voxel of the lists, which are by owner, the block of side^3 voxels around it, of those that the
// owner has and this rank does not hold.
void widen_to_blocks(const Setup& setup, std::int64_t side, ListPerRank& needed);

}  // namespace footwall::extract
