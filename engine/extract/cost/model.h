// How long an extraction will take, phase by phase.
// Based on: seed 004, equations 3.17 (minimum), 3.20 (block) and 3.30 (bounding), with push and reduce beside
// them; differs in that
// - a block's voxels are a slab (cover.h), not (b^3 - b^2) times the face's;
// - a bounding volume's voxels are counted from the boxes, not guessed as |C|^(3/2);
// - a round of messages costs alpha + messages x overhead (with overhead = alpha it is the seed's);
// - what several ranks do on one core adds up: a phase lasts as long as the busiest rank, or as all the work
//   together takes the cores, whichever is longer.
#pragma once
#include <span>

#include "engine/extract/choice.h"
#include "engine/extract/cost/rates.h"
#include "engine/extract/cost/sample.h"
#include "engine/extract/face.h"

namespace footwall::extract {

struct Workload {
  std::span<const RankAmounts> ranks;
  int threads = 1;             // of each rank
  bool discontinuity = false;  // computed, too
  double whole_face = 0;       // s that each voxel of a face costs in computations that need all of them
  double cached = 0;           // the share of remote voxels that will be there already, 0..1
};

// Whether the model knows an exchange strategy with its parameters; what it does not know `auto` does not
// choose. Of `block` it knows the sides of kBlockSides, and 1.
bool has_model(const Choice& exchange);
// Seconds of the phases voxelize, exchange and compute, and their sum as total. Throws kInternal where there
// is no model.
Seconds predict(const Choice& exchange, const Workload& workload, const MachineRates& rates);

// Bytes of a partial sum in a message of `reduce`: typical, it depends on the values.
inline constexpr double kPartialSumBytes = 56;

}  // namespace footwall::extract
