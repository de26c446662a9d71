#include "engine/isosurface/visible/passes.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::isosurface {

void VisibleReport::sum_up() {
  triangles = 0;
  for (const VisiblePass& pass : passes) triangles += pass.triangles;
  std::int64_t so_far = 0;
  for (VisiblePass& pass : passes) {
    so_far += pass.triangles;
    pass.percent = triangles > 0 ? 100.0 * static_cast<double>(so_far) / static_cast<double>(triangles) : 100;
  }
}

double load_difference(const std::vector<std::int64_t>& cells_of_ranks,
                       const std::vector<std::int64_t>& triangles_of_ranks) {
  require(cells_of_ranks.size() == triangles_of_ranks.size(), "cells and triangles of the same ranks");
  std::int64_t most = 0;
  std::int64_t all = 0;
  std::int64_t ranks = 0;
  for (std::size_t rank = 0; rank < cells_of_ranks.size(); ++rank) {
    if (cells_of_ranks[rank] == 0) continue;
    ++ranks;
    all += triangles_of_ranks[rank];
    most = std::max(most, triangles_of_ranks[rank]);
  }
  if (all == 0) return 0;
  return static_cast<double>(most) * static_cast<double>(ranks) / static_cast<double>(all) - 1;
}

}  // namespace footwall::isosurface
