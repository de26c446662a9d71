// The voxels of a row, brick by brick, many columns at once.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace footwall::extract {

// Bit b of byte a of `bits`: the voxel a along u and b along w of the brick (u, w); not all zero.
struct RowTile {
  std::int32_t u = 0;
  std::int32_t w = 0;
  std::uint64_t bits = 0;
};

// The tiles of columns u0 .. u0 + lo.size() - 1 whose voxels are lo[n] .. hi[n] along w, in no particular
// order; a column with lo above hi has none. lo and hi have the same size, numbers are not negative where
// there are voxels. What was in `tiles` is lost.
void list_tiles(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi, std::int32_t u0,
                std::vector<RowTile>& tiles);

}  // namespace footwall::extract
