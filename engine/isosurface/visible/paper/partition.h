// Who extracts which cells: the picture is cut into as many tiles as there are ranks.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/coverage_mask.h"

namespace footwall::isosurface {

struct PlacedWork {
  render::PixelRect box;  // of the cell in the picture
  std::int64_t work = 0;  // estimated, >= 0
};

// The rank of each cell. A tile for P ranks is cut across its longest side into one for ceil(P / 2) and one
// for floor(P / 2) of them, where the work of the cells with their boxes' centres on either side is in that
// proportion as nearly as whole cells allow, and so on. Cells whose centres are level are told apart by the
// other coordinate, then by their order: a straight cut could not divide them.
// Based on: seed 003, section 3.3; differs in that P need not be a power of two.
std::vector<int> partition_picture(std::span<const PlacedWork> cells, int width, int height, int ranks);

// The rank that each tile goes to: the one with the most work to the rank with the fewest triangles so far,
// and so on; ties by number. As many tiles as ranks. The paper does not say who gets which tile; where passes
// of a few cells always go to the same ranks, small differences add up.
std::vector<int> deal_tiles(std::span<const std::int64_t> work_of_tiles,
                            std::span<const std::int64_t> triangles_of_ranks);

}  // namespace footwall::isosurface
