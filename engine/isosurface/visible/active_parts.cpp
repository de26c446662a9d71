#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/visible/active_parts.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "engine/isosurface/visible/active_parts.h"

#ifndef FOOTWALL_ISOSURFACE_BRICK_SAMPLES
#define FOOTWALL_ISOSURFACE_BRICK_SAMPLES
namespace footwall::isosurface {

// Of one brick: `first` is its lowest sample; up to 9 each way.
struct BrickSamples {
  const float* first = nullptr;
  std::array<std::int64_t, 3> size{};
  std::int64_t row_step = 0;
  std::int64_t plane_step = 0;
};

}  // namespace footwall::isosurface
#endif

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Bit k: sample k of a row of 9 is at or above the isovalue; eight at once where vectors can.
HWY_INLINE unsigned signs_of_nine(const float* row, float isovalue) {
  const hn::CappedTag<float, 8> d;
  const std::size_t lanes = hn::Lanes(d);
  unsigned bits = row[8] >= isovalue ? 256U : 0U;
  for (std::size_t k = 0; k < 8; k += lanes) {
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, hn::Ge(hn::LoadU(d, row + k), hn::Set(d, isovalue)), some);
    bits |= unsigned{some[0]} << k;
  }
  return bits;
}

HWY_INLINE unsigned signs_of_row(const float* row, std::int64_t size, float isovalue) {
  if (HWY_LIKELY(size == 9)) return signs_of_nine(row, isovalue);
  unsigned bits = 0;
  for (std::int64_t k = 0; k < size; ++k) bits |= (row[k] >= isovalue ? 1U : 0U) << static_cast<unsigned>(k);
  // Beyond the volume as its last sample: no other side is met there.
  if ((bits >> static_cast<unsigned>(size - 1) & 1U) != 0) bits |= ~0U << static_cast<unsigned>(size);
  return bits & 511U;
}

BrickParts find_parts(const BrickSamples& samples, float isovalue) {
  // Of samples 2 a to 2 a + 2 along i, by row j: whether any, and whether all, are inside.
  std::array<std::array<unsigned, 9>, 4> some{};
  std::array<std::array<unsigned, 9>, 4> every;
  for (auto& rows : every) rows.fill(511);
  for (std::int64_t i = 0; i < samples.size[0]; ++i) {
    const auto a = static_cast<std::size_t>(i / 2);
    for (std::int64_t j = 0; j < samples.size[1]; ++j) {
      const auto r = static_cast<std::size_t>(j);
      const unsigned bits = signs_of_row(samples.first + i * samples.plane_step + j * samples.row_step,
                                         samples.size[2], isovalue);
      if (a < 4) {
        some[a][r] |= bits;
        every[a][r] &= bits;
      }
      if (i % 2 == 0 && a > 0) {
        some[a - 1][r] |= bits;
        every[a - 1][r] &= bits;
      }
    }
  }
  BrickParts parts = 0;
  const unsigned with_cells = (1U << static_cast<unsigned>(samples.size[2] / 2)) - 1;
  for (std::size_t a = 0; a < 4; ++a) {
    if (static_cast<std::int64_t>(2 * a + 1) >= samples.size[0]) break;
    for (std::size_t b = 0; b < 4; ++b) {
      if (static_cast<std::int64_t>(2 * b + 1) >= samples.size[1]) break;
      unsigned any = some[a][2 * b] | some[a][2 * b + 1];
      unsigned all = every[a][2 * b] & every[a][2 * b + 1];
      if (static_cast<std::int64_t>(2 * b + 2) < samples.size[1]) {
        any |= some[a][2 * b + 2];
        all &= every[a][2 * b + 2];
      }
      any |= any >> 1 | any >> 2;
      all &= all >> 1 & all >> 2;
      const unsigned mixed = any & ~all;
      const unsigned four = (mixed & 1U) | (mixed >> 1 & 2U) | (mixed >> 2 & 4U) | (mixed >> 3 & 8U);
      parts |= static_cast<BrickParts>(four & with_cells) << (16 * a + 4 * b);
    }
  }
  return parts;
}

}  // namespace
}  // namespace footwall::isosurface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface {
namespace {

HWY_EXPORT(find_parts);

BrickSamples samples_of(const Field& field, const survey::Index& brick) {
  BrickSamples samples;
  survey::Index at{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t first = 8 * brick[axis];
    at[axis] = first - field.origin[axis];
    samples.size[axis] = std::min<std::int64_t>(9, field.volume_size[axis] - first);
  }
  samples.row_step = field.size[2];
  samples.plane_step = field.size[1] * field.size[2];
  samples.first = field.values.data() + at[0] * samples.plane_step + at[1] * samples.row_step + at[2];
  return samples;
}

}  // namespace

BrickParts active_parts(const Field& field, const survey::Index& brick, float isovalue) {
  const BrickSamples samples = samples_of(field, brick);
  if (std::min({samples.size[0], samples.size[1], samples.size[2]}) < 2) return 0;  // no cells
  return HWY_DYNAMIC_DISPATCH(find_parts)(samples, isovalue);
}

void fetch_brick(const Field& field, const survey::Index& brick) {
  const BrickSamples samples = samples_of(field, brick);
  for (std::int64_t i = 0; i < samples.size[0]; ++i) {
    for (std::int64_t j = 0; j < samples.size[1]; ++j) {
      const float* const row = samples.first + i * samples.plane_step + j * samples.row_step;
      __builtin_prefetch(row);
      __builtin_prefetch(row + samples.size[2] - 1);
    }
  }
}

}  // namespace footwall::isosurface
#endif
