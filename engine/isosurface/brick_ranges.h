// Which values occur in the bricks of a volume that is in memory; for volumes on disk storage/volume keeps
// the same tables.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

struct BrickRanges {
  survey::Index dims{0, 0, 0};
  std::vector<float> min;
  std::vector<float> max;
  std::vector<std::uint8_t> has_null;

  // Valid as long as the ranges are.
  Bricks tables() const { return {dims, min, max, has_null}; }
};

// Reads every sample of the field. The bricks are those of the whole volume; of a part of it they are right
// for the cells of the field, and a brick without a sample there is as if all were null. Throws Error
// kInvalid for a field without samples, or one that does not lie in its volume.
BrickRanges brick_ranges(const Field& field, int threads);

}  // namespace footwall::isosurface
