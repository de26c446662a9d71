// Lists of voxels as they are sent: values in the order of bricks and bits, with or without coordinates.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/extract/blocks.h"
#include "engine/extract/cache/brick.h"

namespace footwall::extract {

// A voxel as a request names it: 12 bytes, as in seed 004, section 3.4.1.
using Coordinates = std::array<std::int32_t, 3>;
static_assert(sizeof(Coordinates) == 12);

// The values of a list of own voxels, as many as it has.
void gather(const Blocks& blocks, const BrickList& list, std::span<float> values);

// Where they are, in the same order.
void coordinates_of(const BrickList& list, std::span<Coordinates> coordinates);
// The list whose coordinates these are. Throws kInternal for coordinates that coordinates_of did not write.
BrickList bricks_of(std::span<const Coordinates> coordinates);

}  // namespace footwall::extract
