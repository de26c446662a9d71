// Compiled once per instruction set and chosen at run time; comparisons give the same bits on all of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/bit_planes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <type_traits>

#include "engine/isosurface/detail/bit_planes.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// One bit for each of 64 values; test(at) is the mask of the lanes from `at` on. Lanes of which no bit is
// wanted are left out.
template <bool kAll, class Test>
HWY_INLINE std::uint64_t word_of([[maybe_unused]] std::uint64_t wanted, Test&& test) {
  const hn::ScalableTag<float> d;
  constexpr std::size_t kLanes = hn::MaxLanes(hn::ScalableTag<float>());
  constexpr std::uint64_t kGroup = (std::uint64_t{1} << kLanes) - 1;
  using Part = std::conditional_t<(kLanes > 8), std::uint16_t, std::uint8_t>;
  static_assert(kLanes <= 16);
  std::uint64_t word = 0;
  for (std::size_t at = 0; at < 64; at += kLanes) {
    if (!kAll && (wanted >> at & kGroup) == 0) continue;
    std::uint8_t bits[sizeof(Part)];
    hn::StoreMaskBits(d, test(at), bits);
    word |= std::uint64_t{std::bit_cast<Part>(bits)} << at;
  }
  return word;
}

using Sum = hn::Vec<hn::ScalableTag<float>>;

// `sum` becomes no number where there is a null (and it may for infinite values, too).
template <bool kAll>
HWY_INLINE std::uint64_t sign_word(const float* HWY_RESTRICT samples, Sum level, std::uint64_t wanted,
                                   Sum& sum) {
  const hn::ScalableTag<float> d;
  return word_of<kAll>(wanted, [&](std::size_t at) HWY_ATTR {
    const auto v = hn::LoadU(d, samples + at);
    sum = hn::Add(sum, v);
    return hn::Ge(v, level);
  });
}

HWY_INLINE std::uint64_t known_word(const float* HWY_RESTRICT samples) {
  const hn::ScalableTag<float> d;
  return word_of<true>(0, [&](std::size_t at) HWY_ATTR {
    const auto v = hn::LoadU(d, samples + at);
    return hn::Eq(v, v);
  });
}

// The processor's own prefetching ends with each small page.
HWY_INLINE void prefetch(const float* samples) {
  constexpr std::size_t kAhead = 384;
  for (std::size_t line = 0; line < 64; line += 16) hwy::Prefetch(samples + kAhead + line);
}

// cells: the rows of cells around the row of samples.
void scan_row(const Frame& frame, const float* samples, const std::uint64_t* const* cells, int count,
              const BitPlanes::Row& into) {
  const hn::ScalableTag<float> d;
  const auto level = hn::Set(d, frame.isovalue);
  auto sum = hn::Zero(d);
  const float* const end = frame.values + frame.field->values.size();
  // The last word of the field's last rows would be read from beyond the end.
  alignas(64) float last[64] = {};
  const auto samples_of = [&](std::size_t w) -> const float* {
    const float* const at = samples + 64 * w;
    if (HWY_LIKELY(end - at >= 64)) return at;
    std::copy(at, end, last);
    return last;
  };
  const auto wanted_of = [&](std::size_t w) {
    std::uint64_t cell = 0;
    std::uint64_t before = 0;
    for (int n = 0; n < count; ++n) {
      cell |= cells[n][w];
      if (w > 0) before |= cells[n][w - 1] >> 63;
    }
    return cell | cell << 1 | before;
  };
  for (std::size_t w = 0; w < frame.words; ++w) {
    const std::uint64_t wanted = wanted_of(w);
    if (wanted == ~std::uint64_t{0}) {
      prefetch(samples + 64 * w);
      into.inside[w] = sign_word<true>(samples_of(w), level, wanted, sum);
    } else if (wanted != 0) {
      into.inside[w] = sign_word<false>(samples_of(w), level, wanted, sum);
    }
  }
  *into.has_null = hn::AllTrue(d, hn::Eq(sum, sum)) ? 0 : 1;
  if (HWY_LIKELY(*into.has_null == 0)) return;
  for (std::size_t w = 0; w < frame.words; ++w)
    into.known[w] = wanted_of(w) == 0 ? 0 : known_word(samples_of(w));
}

void scan_plane(const Frame& frame, const CellMasks& masks, std::int64_t p, BitPlanes& into) {
  for (std::int64_t r = 0; r < frame.sample_rows; ++r) {
    const std::uint64_t* around[4];
    int count = 0;
    for (std::int64_t n = 0; n < 4; ++n) {
      const std::int64_t cell_p = p - (n & 1);
      const std::int64_t cell_r = r - (n >> 1);
      if (cell_p < 0 || cell_r < 0 || cell_p >= frame.cell_planes || cell_r >= frame.cell_rows) continue;
      const std::uint64_t* const mask = masks.row(cell_p, cell_r);
      if (mask == nullptr || (count > 0 && around[count - 1] == mask)) continue;
      around[count++] = mask;
    }
    if (count > 0) scan_row(frame, frame.samples(p, r), around, count, into.row_to_scan(p, r));
  }
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(scan_plane);

}  // namespace

BitPlanes::BitPlanes(const Frame& frame)
    : rows_(frame.sample_rows),
      words_(frame.words),
      inside_(static_cast<std::size_t>(kPlanes * rows_) * words_ + 1),
      known_(inside_.size()),
      has_null_(static_cast<std::size_t>(kPlanes * rows_)) {}

void BitPlanes::scan(const Frame& frame, const CellMasks& masks, std::int64_t p) {
  if ((p == frame.cell_planes || masks.plane_is_empty(p)) && (p == 0 || masks.plane_is_empty(p - 1))) return;
  HWY_DYNAMIC_DISPATCH(scan_plane)(frame, masks, p, *this);
}

}  // namespace footwall::isosurface::detail
#endif
