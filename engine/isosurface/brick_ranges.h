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

// Of a field that is a whole volume; reads every sample. Throws Error kInvalid for a part of a volume.
BrickRanges brick_ranges(const Field& volume, int threads);

}  // namespace footwall::isosurface
