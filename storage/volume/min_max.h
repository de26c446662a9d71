// The min/max pyramid: which values can occur in a brick of cells, so that an isosurface skips what it cannot
// cross.
#pragma once
#include <cstdint>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::volume {

// Entry (a,b,c) of level L covers the samples s*a .. s*a + s inclusive on each axis (cut at the volume's
// end), where s = 8 * 2^L: the samples of all cells of a brick, so neighbouring entries share a layer of
// samples.
struct MinMaxLevel {
  survey::Index dims{1, 1, 1};
  std::int64_t step = 8;
  // [a][b][c]; +infinity and -infinity where every sample is null.
  std::vector<float> min;
  std::vector<float> max;
  std::vector<std::uint8_t> has_null;  // 1 where at least one sample is null

  std::size_t at(std::int64_t a, std::int64_t b, std::int64_t c) const {
    return static_cast<std::size_t>((a * dims[1] + b) * dims[2] + c);
  }
};

// Entries per axis at a level: max(1, ceil((n - 1) / step)).
survey::Index min_max_dims(const survey::Index& volume_dims, int level);
// Levels 0 .. count - 1; the last one has a single entry.
int min_max_levels(const survey::Index& volume_dims);

}  // namespace footwall::volume
