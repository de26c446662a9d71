// What `minimum` and `block` have in common: the responsible rank asks the owners by coordinates.
#pragma once
#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

// Steps: 1 voxelize: the voxels that this rank's faces need and that it neither holds nor has cached, each
// with the block of side^3 voxels around it; 2 exchange: requests, 12 bytes a voxel, each voxel once per pair
// of ranks; 3 compute: looks up what it is asked for; 4 exchange: the values, 4 bytes each, in the same
// order; 5 compute: keep what came, and all faces.
Outcome exchange_by_request(const Setup& setup, std::int64_t side);

}  // namespace footwall::extract
