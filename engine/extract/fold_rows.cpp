#include "engine/extract/fold_rows.h"

#include <limits>

namespace footwall::extract {

static_assert(kWindowBlock <= kBlockValues);

namespace {

// Into the second-level cache: a buffer's lines would take the whole of the first.
constexpr int kNear = 2;

}  // namespace

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
  if (w_stride > std::numeric_limits<std::int32_t>::max()) {  // an inline of 8 GiB
    voxels_from(row, column, 0, row.lo.size(), 0);
    return;
  }
  const Strides strides{u_stride, static_cast<std::int32_t>(w_stride)};
  for (std::size_t n = 0; n < row.lo.size(); n += kPlaceColumns) {
    const std::size_t count = std::min(kPlaceColumns, row.lo.size() - n);
    std::int32_t longest = 0;
    const std::size_t listed = list_places(row.lo.subspan(n, count), row.hi.subspan(n, count), column,
                                           strides, places_ + used_, longest);
    const float* data = block_.data();
    for (std::size_t k = used_; k < used_ + listed; ++k) __builtin_prefetch(data + places_[k], 0, kNear);
    used_ += listed;
    while (used_ >= capacity_) flush();
    // A column of a face has at most 4 voxels unless the face is a line.
    if (longest > static_cast<std::int32_t>(kPlacesOfColumn))
      voxels_from(row, column, n, n + count, kPlacesOfColumn);
    column += static_cast<std::int64_t>(count) * u_stride;
  }
}

// The columns first..last-1, of which `column` is the place of the first at w = 0, without the voxels that
// were listed.
void RowFolder::voxels_from(const voxelize::Row& row, std::int64_t column, std::size_t first,
                            std::size_t last, std::int64_t skipped) {
  const std::int64_t u_stride = block_.strides()[static_cast<std::size_t>(row.u_axis)];
  const std::int64_t w_stride = block_.strides()[static_cast<std::size_t>(row.w_axis)];
  for (std::size_t n = first; n < last; ++n, column += u_stride) {
    for (std::int64_t w = row.lo[n] + skipped; w <= row.hi[n]; ++w) place(column + w * w_stride);
  }
}

// Folds the first `capacity_` places, or all where there are fewer.
void RowFolder::flush() {
  const float* data = block_.data();
  const std::size_t n_places = std::min(used_, capacity_);
  for (std::size_t n = 0; n < n_places; ++n) values_[n] = data[places_[n]];
  if (with_discontinuity_) {
    fold_around({data, block_.strides()[0], block_.strides()[1]}, places_, n_places, scale_, windows_,
                partial_.discontinuity);
  }
  fold_block(values_, n_places, partial_.moments);
  std::copy(places_ + n_places, places_ + used_, places_);
  used_ -= n_places;
}

Partial RowFolder::take() {
  while (used_ > 0) flush();
  Partial result = partial_;
  partial_ = {};
  return result;
}

}  // namespace footwall::extract
