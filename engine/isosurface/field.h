// A box of samples of a volume, in memory, and the cells to look at in it.
#pragma once
#include <span>

#include "storage/survey/box.h"

namespace footwall::isosurface {

// Sample (i, j, k) of the box, counted from its own first sample, is values[(i * size[1] + j) * size[2] + k].
// NaN = null. `origin` is the index of the first sample in the volume: positions and keys are the volume's,
// so that parts of a volume give the same vertices, bit for bit, as the whole.
struct Field {
  std::span<const float> values;
  survey::Index size{0, 0, 0};
  survey::Index origin{0, 0, 0};
  survey::Index volume_size{0, 0, 0};  // samples of the whole volume; origin + size lies inside
};

// The cell at (i, j, k) has the samples i..i+1, j..j+1, k..k+1. All cells of the field.
inline survey::Box cells_of(const Field& field) {
  survey::Box cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] = field.origin[axis];
    cells.hi[axis] = field.origin[axis] + field.size[axis] - 1;
  }
  return cells;
}

}  // namespace footwall::isosurface
