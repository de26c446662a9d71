#include "engine/extract/fold_rows.h"

namespace footwall::extract {

static_assert(kWindowBlock <= kBlockValues);

RowFolder::RowFolder(const Block& block, bool with_discontinuity, double scale)
    : block_(block),
      with_discontinuity_(with_discontinuity),
      scale_(scale),
      capacity_(with_discontinuity ? kWindowBlock : kBlockValues) {}

void RowFolder::row(const voxelize::Row& row) {
  survey::Index first{};
  first[static_cast<std::size_t>(row.u_axis)] = row.u0;
  first[static_cast<std::size_t>(row.v_axis)] = row.v;
  std::int64_t column = block_.offset(first);
  const std::int64_t u_stride = block_.strides()[static_cast<std::size_t>(row.u_axis)];
  const std::int64_t w_stride = block_.strides()[static_cast<std::size_t>(row.w_axis)];
  for (std::size_t n = 0; n < row.lo.size(); ++n, column += u_stride) {
    std::int64_t length = std::int64_t{row.hi[n]} - row.lo[n] + 1;
    std::int64_t place = column + row.lo[n] * w_stride;
    // A column of a face has at most 4 voxels unless the face is a line: written without asking how many.
    for (; length > 0; length -= kColumn, place += kColumn * w_stride) {
      if (used_ + static_cast<std::size_t>(kColumn) > capacity_) flush();
      for (std::int64_t k = 0; k < kColumn; ++k)
        places_[used_ + static_cast<std::size_t>(k)] = place + k * w_stride;
      used_ += static_cast<std::size_t>(std::min(length, kColumn));
    }
  }
}

void RowFolder::flush() {
  const float* data = block_.data();
  if (!with_discontinuity_) {
    for (std::size_t n = 0; n < used_; ++n) values_[n] = data[places_[n]];
  } else {
    const std::int64_t i_stride = block_.strides()[0];
    const std::int64_t j_stride = block_.strides()[1];
    for (std::size_t k = 0; k < kNeighbours; ++k) {
      const float* shifted = data + (static_cast<std::int64_t>(k / 3) - 1) * i_stride +
                             (static_cast<std::int64_t>(k % 3) - 1) * j_stride;
      for (std::size_t n = 0; n < used_; ++n) windows_.value[k][n] = shifted[places_[n]];
    }
    std::copy_n(windows_.value[kNeighbours / 2], used_, values_);
    fold_windows(windows_, used_, scale_, partial_.discontinuity);
  }
  fold_block(values_, used_, partial_.moments);
  used_ = 0;
}

Partial RowFolder::take() {
  if (used_ > 0) flush();
  Partial result = partial_;
  partial_ = {};
  return result;
}

}  // namespace footwall::extract
