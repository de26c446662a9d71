#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/brick_ranges.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/detail/threads.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Folds a row into the least and greatest of each place, and counts nulls by adding 1.
void fold_row(const float* HWY_RESTRICT row, std::size_t size, float* HWY_RESTRICT least,
              float* HWY_RESTRICT greatest, float* HWY_RESTRICT nulls) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto one = hn::Set(d, 1.0F);
  std::size_t k = 0;
  for (; k + lanes <= size; k += lanes) {
    const auto v = hn::LoadU(d, row + k);
    const auto low = hn::LoadU(d, least + k);
    const auto high = hn::LoadU(d, greatest + k);
    // Comparisons are false for nulls, which min and max instructions treat each in their way.
    hn::StoreU(hn::IfThenElse(hn::Lt(v, low), v, low), d, least + k);
    hn::StoreU(hn::IfThenElse(hn::Gt(v, high), v, high), d, greatest + k);
    const auto null = hn::IsNaN(v);
    if (HWY_UNLIKELY(!hn::AllFalse(d, null))) {
      hn::StoreU(hn::Add(hn::LoadU(d, nulls + k), hn::IfThenElseZero(null, one)), d, nulls + k);
    }
  }
  for (; k < size; ++k) {
    if (row[k] < least[k]) least[k] = row[k];
    if (row[k] > greatest[k]) greatest[k] = row[k];
    if (row[k] != row[k]) nulls[k] += 1;
  }
}

}  // namespace
}  // namespace footwall::isosurface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface {
namespace {

HWY_EXPORT(fold_row);

constexpr std::int64_t kStep = 8;

// The samples of brick n on an axis that the field has, counted from its first.
struct Samples {
  std::int64_t begin;
  std::int64_t end;  // at or before begin: none
};
Samples samples_of(const Field& field, int axis, std::int64_t n) {
  return {std::max<std::int64_t>(0, n * kStep - field.origin[axis]),
          std::min(n * kStep + kStep + 1 - field.origin[axis], field.size[axis])};
}

// All bricks [a][b][c] of a row.
void fold_bricks(const Field& field, std::int64_t a, std::int64_t b, BrickRanges& into) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const auto size = static_cast<std::size_t>(field.size[2]);
  std::vector<float> least(size, kInf);
  std::vector<float> greatest(size, -kInf);
  std::vector<float> nulls(size, 0);
  const auto fold = HWY_DYNAMIC_DISPATCH(fold_row);
  const Samples along_i = samples_of(field, 0, a);
  const Samples along_j = samples_of(field, 1, b);
  for (std::int64_t i = along_i.begin; i < along_i.end; ++i) {
    for (std::int64_t j = along_j.begin; j < along_j.end; ++j) {
      fold(field.values.data() + (i * field.size[1] + j) * field.size[2], size, least.data(), greatest.data(),
           nulls.data());
    }
  }
  for (std::int64_t c = 0; c < into.dims[2]; ++c) {
    const auto brick = static_cast<std::size_t>((a * into.dims[1] + b) * into.dims[2] + c);
    const Samples along_k = samples_of(field, 2, c);
    into.min[brick] = kInf;
    into.max[brick] = -kInf;
    into.has_null[brick] = 0;
    for (std::int64_t k = along_k.begin; k < along_k.end; ++k) {
      const auto at = static_cast<std::size_t>(k);
      into.min[brick] = std::min(into.min[brick], least[at]);
      into.max[brick] = std::max(into.max[brick], greatest[at]);
      if (nulls[at] > 0) into.has_null[brick] = 1;
    }
  }
}

bool is_in_its_volume(const Field& field) {
  for (int axis = 0; axis < 3; ++axis) {
    if (field.size[axis] < 1 || field.origin[axis] < 0 ||
        field.origin[axis] + field.size[axis] > field.volume_size[axis])
      return false;
  }
  return true;
}

}  // namespace

BrickRanges brick_ranges(const Field& field, int threads) {
  if (!is_in_its_volume(field)) {
    throw Error(ErrorCode::kInvalid, "bricks are made of samples of a volume");
  }
  voxelize::apply_forced_simd();
  BrickRanges ranges;
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    ranges.dims[axis] = std::max<std::int64_t>(1, (field.volume_size[axis] - 1 + kStep - 1) / kStep);
    count *= static_cast<std::size_t>(ranges.dims[axis]);
  }
  ranges.min.resize(count);
  ranges.max.resize(count);
  ranges.has_null.resize(count);
  detail::for_each_in_parallel(ranges.dims[0] * ranges.dims[1], threads, [&](std::int64_t row, int) {
    fold_bricks(field, row / ranges.dims[1], row % ranges.dims[1], ranges);
  });
  return ranges;
}

}  // namespace footwall::isosurface
#endif
