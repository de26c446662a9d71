// Compiled once per instruction set and chosen at run time; comparisons give the same bits on all of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/bit_planes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <type_traits>

#include "engine/isosurface/detail/bit_planes.h"
#include "engine/isosurface/detail/threads.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// One bit for each of 64 values; test(at) is the mask of the lanes from `at` on.
template <class Test>
HWY_INLINE std::uint64_t word_of(Test&& test) {
  const hn::ScalableTag<float> d;
  constexpr std::size_t kLanes = hn::MaxLanes(hn::ScalableTag<float>());
  using Part = std::conditional_t<(kLanes > 8), std::uint16_t, std::uint8_t>;
  static_assert(kLanes <= 16);
  std::uint64_t word = 0;
  for (std::size_t at = 0; at < 64; at += kLanes) {
    std::uint8_t bits[sizeof(Part)];
    hn::StoreMaskBits(d, test(at), bits);
    word |= std::uint64_t{std::bit_cast<Part>(bits)} << at;
  }
  return word;
}

// Whether there may be a null: then the sum is no number; it may be none for infinite values, too.
bool sign_words(const float* HWY_RESTRICT samples, std::size_t words, float isovalue,
                std::uint64_t* HWY_RESTRICT into) {
  const hn::ScalableTag<float> d;
  const auto level = hn::Set(d, isovalue);
  auto sum = hn::Zero(d);
  for (std::size_t w = 0; w < words; ++w, samples += 64) {
    into[w] = word_of([&](std::size_t at) HWY_ATTR {
      const auto v = hn::LoadU(d, samples + at);
      sum = hn::Add(sum, v);
      return hn::Ge(v, level);
    });
  }
  return !hn::AllTrue(d, hn::Eq(sum, sum));
}

void known_words(const float* HWY_RESTRICT samples, std::size_t words, std::uint64_t* HWY_RESTRICT into) {
  const hn::ScalableTag<float> d;
  for (std::size_t w = 0; w < words; ++w, samples += 64) {
    into[w] = word_of([&](std::size_t at) HWY_ATTR {
      const auto v = hn::LoadU(d, samples + at);
      return hn::Eq(v, v);
    });
  }
}

// Words [from, to) of one row.
void scan_words(const Frame& frame, std::int64_t p, std::int64_t r, std::size_t from, std::size_t to,
                BitPlanes& into) {
  const std::size_t row = frame.row(p, r);
  const float* samples = frame.samples(p, r);
  const float* const end = frame.values + frame.field->values.size();
  std::uint64_t* const inside = into.inside.data() + row * frame.words;
  std::uint64_t* const known = into.known.data() + row * frame.words;
  // The last word of the field's last rows would read beyond the end.
  alignas(64) float last[64];
  const bool cut = end - samples < static_cast<std::ptrdiff_t>(to * 64);
  const std::size_t whole = cut ? to - 1 : to;
  if (cut) {
    std::fill(std::begin(last), std::end(last), 0.0F);
    std::copy(samples + whole * 64, end, last);
  }
  bool null = false;
  if (from < whole) null |= sign_words(samples + from * 64, whole - from, frame.isovalue, inside + from);
  if (cut) null |= sign_words(last, 1, frame.isovalue, inside + whole);
  if (!null && into.has_null[row] == 0) return;
  // The words before `from` were found free of nulls, or were not looked at and mean nothing.
  if (into.has_null[row] == 0) std::fill(known, known + from, ~std::uint64_t{0});
  into.has_null[row] = 1;
  if (from < whole) known_words(samples + from * 64, whole - from, known + from);
  if (cut) known_words(last, 1, known + whole);
}

void scan_plane(const Frame& frame, const CellMasks& masks, std::int64_t p, BitPlanes& into) {
  for (std::int64_t r = 0; r < frame.sample_rows; ++r) {
    // The up to four rows of cells around this row of samples.
    const std::uint64_t* around[4];
    int count = 0;
    for (const std::int64_t cell_p : {p - 1, p}) {
      for (const std::int64_t cell_r : {r - 1, r}) {
        if (cell_p < 0 || cell_r < 0 || cell_p >= frame.cell_planes || cell_r >= frame.cell_rows) continue;
        const std::uint64_t* const mask = masks.row(cell_p, cell_r);
        if (mask == nullptr || (count > 0 && around[count - 1] == mask)) continue;
        around[count++] = mask;
      }
    }
    if (count == 0) continue;
    std::size_t from = 0;
    bool in_run = false;
    std::uint64_t before = 0;  // the last cell of the word before, whose upper samples stand here
    for (std::size_t w = 0; w < frame.words; ++w) {
      std::uint64_t cells = 0;
      for (int n = 0; n < count; ++n) cells |= around[n][w];
      const bool wanted = (cells | before) != 0;
      before = cells >> 63;
      if (wanted && !in_run) from = w;
      if (!wanted && in_run) scan_words(frame, p, r, from, w, into);
      in_run = wanted;
    }
    if (in_run) scan_words(frame, p, r, from, frame.words, into);
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

void find_signs(const Frame& frame, const CellMasks& masks, int threads, BitPlanes& into) {
  const std::size_t rows = frame.row(frame.sample_planes, 0);
  into.inside.resize_uninitialised(rows * frame.words + 1);
  into.known.resize_uninitialised(rows * frame.words + 1);
  into.has_null.assign(rows, 0);
  // So that the word after the last one can be read.
  into.inside[rows * frame.words] = 0;
  into.known[rows * frame.words] = 0;
  for_each_in_parallel(frame.sample_planes, threads, [&](std::int64_t p, int) {
    if ((p == frame.cell_planes || masks.plane_is_empty(p)) && (p == 0 || masks.plane_is_empty(p - 1)))
      return;
    HWY_DYNAMIC_DISPATCH(scan_plane)(frame, masks, p, into);
  });
}

}  // namespace footwall::isosurface::detail
#endif
