// The cells to march and the samples that they touch, counted from the field's first sample.
#pragma once
#include <cstddef>
#include <cstdint>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface::detail {

struct Frame {
  Frame(const Field& of, float at, const survey::Box& box);

  const Field* field;
  const float* values;
  std::int64_t row_step;    // from sample (i, j, k) to (i, j + 1, k)
  std::int64_t plane_step;  // to (i + 1, j, k)
  float isovalue;
  survey::Box cells;  // cells.hi are the last samples they touch
  std::int64_t cell_planes;
  std::int64_t cell_rows;  // of a plane
  std::int64_t sample_planes;
  std::int64_t sample_rows;
  // 64-bit words of a row of bits. Bit k stands for sample or cell k of the field's row, so that the words of
  // a row that ends before its last word does have bits that mean nothing.
  std::size_t words;

  // The row of samples (p, r) of the frame, from the field's first k on: 0, 0 is the row of cells.lo.
  const float* samples(std::int64_t p, std::int64_t r) const {
    return values + (cells.lo[0] + p) * plane_step + (cells.lo[1] + r) * row_step;
  }
};

inline Frame::Frame(const Field& of, float at, const survey::Box& box)
    : field(&of),
      values(of.values.data()),
      row_step(of.size[2]),
      plane_step(of.size[1] * of.size[2]),
      isovalue(at),
      cells(box),
      cell_planes(box.size(0)),
      cell_rows(box.size(1)),
      sample_planes(box.size(0) + 1),
      sample_rows(box.size(1) + 1),
      words(static_cast<std::size_t>((of.size[2] + 63) / 64)) {
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] -= of.origin[axis];
    cells.hi[axis] -= of.origin[axis];
  }
}

}  // namespace footwall::isosurface::detail
