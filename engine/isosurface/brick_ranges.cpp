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

// The samples of brick n on an axis.
std::int64_t first_of(std::int64_t n) {
  return n * kStep;
}
std::int64_t last_of(std::int64_t n, std::int64_t size) {
  return std::min(n * kStep + kStep, size - 1);
}

// All bricks [a][b][c] of a row.
void fold_bricks(const Field& volume, std::int64_t a, std::int64_t b, BrickRanges& into) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const auto size = static_cast<std::size_t>(volume.size[2]);
  std::vector<float> least(size, kInf);
  std::vector<float> greatest(size, -kInf);
  std::vector<float> nulls(size, 0);
  const auto fold = HWY_DYNAMIC_DISPATCH(fold_row);
  for (std::int64_t i = first_of(a); i <= last_of(a, volume.size[0]); ++i) {
    for (std::int64_t j = first_of(b); j <= last_of(b, volume.size[1]); ++j) {
      fold(volume.values.data() + (i * volume.size[1] + j) * volume.size[2], size, least.data(),
           greatest.data(), nulls.data());
    }
  }
  for (std::int64_t c = 0; c < into.dims[2]; ++c) {
    const auto brick = static_cast<std::size_t>((a * into.dims[1] + b) * into.dims[2] + c);
    const auto from = first_of(c);
    const auto to = last_of(c, volume.size[2]) + 1;
    into.min[brick] = *std::min_element(least.begin() + from, least.begin() + to);
    into.max[brick] = *std::max_element(greatest.begin() + from, greatest.begin() + to);
    const bool null = std::any_of(nulls.begin() + from, nulls.begin() + to, [](float n) { return n > 0; });
    into.has_null[brick] = null ? 1 : 0;
  }
}

}  // namespace

BrickRanges brick_ranges(const Field& volume, int threads) {
  if (volume.size != volume.volume_size || volume.size[0] < 1 || volume.size[1] < 1 || volume.size[2] < 1) {
    throw Error(ErrorCode::kInvalid, "bricks are made of a whole volume");
  }
  voxelize::apply_forced_simd();
  BrickRanges ranges;
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    ranges.dims[axis] = std::max<std::int64_t>(1, (volume.size[axis] - 1 + kStep - 1) / kStep);
    count *= static_cast<std::size_t>(ranges.dims[axis]);
  }
  ranges.min.resize(count);
  ranges.max.resize(count);
  ranges.has_null.resize(count);
  detail::for_each_in_parallel(ranges.dims[0] * ranges.dims[1], threads, [&](std::int64_t row, int) {
    fold_bricks(volume, row / ranges.dims[1], row % ranges.dims[1], ranges);
  });
  return ranges;
}

}  // namespace footwall::isosurface
#endif
