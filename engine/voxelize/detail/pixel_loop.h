// Pixels back into voxels: the two inner loops of the seed's method.
#pragma once
#include <span>

#include "engine/voxelize/detail/pixel_columns.h"

namespace footwall::voxelize::detail {

// The voxels of pixels (x, first), (x, first + 1), ...; compiled once for each instruction set, no branch
// inside, writes nothing but `out`.
void turn_back(const FlatTriangle& flat, std::int64_t x, std::int64_t first, std::span<Voxel> out);

// As printed in appendix E.3.2, for the x in [x_first, x_last): up from y = 0, looking at each pixel whether
// it lies on an edge. Appends those in the box.
void look_and_turn_back(const FlatTriangle& flat, const Edges& edges, std::int64_t x_first,
                        std::int64_t x_last, const survey::Box& box, std::vector<Voxel>& out);

}  // namespace footwall::voxelize::detail
