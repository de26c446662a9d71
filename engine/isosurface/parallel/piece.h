// What one rank has of an isosurface: a surface for each of its pillars, and how their triangles are numbered
// in the whole.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

// Triangles of the whole surface are numbered by their cells' rows (i, j), [i][j], then by k, then by the
// order in the cell's pattern: the same numbers for any rank count and decomposition.
struct Piece {
  Surface surface;
  // The number of the first triangle of each row (i, j) of surface.cells, [i][j]; those of a row follow each
  // other.
  std::vector<std::uint64_t> row_numbers;
};

}  // namespace footwall::isosurface
