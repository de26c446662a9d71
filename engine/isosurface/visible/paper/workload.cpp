#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/visible/paper/workload.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <cstring>

#include "engine/isosurface/visible/paper/workload.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Of rows of `size` <= 64 samples that lie `step` samples apart.
void find_sides(const float* HWY_RESTRICT row, std::size_t rows, std::int64_t step, std::size_t size,
                float isovalue, Workload::Sides* HWY_RESTRICT to) {
  const hn::CappedTag<float, 64> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto at = hn::Set(d, isovalue);
  for (std::size_t n = 0; n < rows; ++n, row += step) {
    Workload::Sides sides;
    for (std::size_t k = 0; k < size; k += lanes) {
      // Comparisons are false for nulls.
      const auto there = hn::FirstN(d, size - k);
      const auto v = hn::MaskedLoad(there, d, row + k);
      std::uint8_t below[8] = {};
      std::uint8_t above[8] = {};
      hn::StoreMaskBits(d, hn::And(there, hn::Lt(v, at)), below);
      hn::StoreMaskBits(d, hn::And(there, hn::Ge(v, at)), above);
      std::uint64_t bits = 0;
      std::memcpy(&bits, below, sizeof bits);
      sides.below |= bits << k;
      std::memcpy(&bits, above, sizeof bits);
      sides.above |= bits << k;
    }
    to[n] = sides;
  }
}

}  // namespace
}  // namespace footwall::isosurface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

HWY_EXPORT(find_sides);

constexpr std::int64_t kWord = 64;

// Bit n: whether one of the bits n .. n + further is set.
std::uint64_t any_of_next(std::uint64_t bits, std::int64_t further) {
  std::uint64_t any = bits;
  for (std::int64_t reach = 0; reach < further;) {
    const std::int64_t by = std::min(reach + 1, further - reach);
    any |= any >> static_cast<unsigned>(by);
    reach += by;
  }
  return any;
}

}  // namespace

std::int64_t Workload::of(const Field& field, const survey::Box& cells, float isovalue,
                          const survey::Index& block) {
  for (const std::int64_t size : block) {
    if (size >= 1 && size <= kMostCells) continue;
    throw Error(ErrorCode::kUsage, fmt::format("work cannot be estimated in cells of {}", size),
                fmt::format("give 1 to {}", kMostCells));
  }
  if (cells.empty()) return 0;
  voxelize::apply_forced_simd();
  const auto find = HWY_DYNAMIC_DISPATCH(find_sides);
  // As many whole blocks along samples as a word has bits for, with the last one's last sample.
  const std::int64_t stretch = (kWord - 1) / block[2] * block[2];
  std::int64_t count = 0;
  survey::Box part = cells;
  for (; part.lo[2] < cells.hi[2]; part.lo[2] = part.hi[2]) {
    part.hi[2] = std::min(part.lo[2] + stretch, cells.hi[2]);
    const auto rows = static_cast<std::size_t>(part.size(1) + 1);
    rows_.resize(static_cast<std::size_t>(part.size(0) + 1) * rows);
    Sides* to = rows_.data();
    for (std::int64_t i = part.lo[0]; i <= part.hi[0]; ++i, to += rows) {
      const float* const row =
          field.values.data() +
          ((i - field.origin[0]) * field.size[1] + part.lo[1] - field.origin[1]) * field.size[2] +
          part.lo[2] - field.origin[2];
      find(row, rows, field.size[2], static_cast<std::size_t>(part.size(2) + 1), isovalue, to);
    }
    count += of_stretch(part, block);
  }
  return count;
}

std::int64_t Workload::of_stretch(const survey::Box& cells, const survey::Index& block) {
  const std::int64_t rows = cells.size(1) + 1;
  std::uint64_t firsts = 0;  // the first sample of each block
  for (std::int64_t k = 0; k < cells.size(2); k += block[2])
    firsts |= std::uint64_t{1} << static_cast<unsigned>(k);
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < cells.size(0); i += block[0]) {
    for (std::int64_t j = 0; j < cells.size(1); j += block[1]) {
      Sides met;
      for (std::int64_t p = i; p <= std::min(i + block[0], cells.size(0)); ++p) {
        for (std::int64_t r = j; r <= std::min(j + block[1], cells.size(1)); ++r) {
          const Sides& row = rows_[static_cast<std::size_t>(p * rows + r)];
          met.below |= row.below;
          met.above |= row.above;
        }
      }
      count += std::popcount(any_of_next(met.below, block[2]) & any_of_next(met.above, block[2]) & firsts);
    }
  }
  return count;
}

}  // namespace footwall::isosurface
#endif
