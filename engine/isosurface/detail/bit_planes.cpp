// Compiled once per instruction set and chosen at run time; comparisons give the same bits on all of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/bit_planes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "engine/isosurface/detail/bit_planes.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Samples that are looked at together: a line of the cache.
constexpr std::size_t kGroup = 16;

using Floats = hn::ScalableTag<float>;
using Float = hn::Vec<Floats>;

// A bit for each of kGroup values; test(at) is the mask of the lanes from `at` on.
template <class Test>
HWY_INLINE std::uint16_t group_of(Test&& test) {
  constexpr std::size_t kLanes = hn::MaxLanes(Floats());
  static_assert(kLanes <= kGroup);
  using Part = std::conditional_t<(kLanes > 8), std::uint16_t, std::uint8_t>;
  unsigned group = 0;
  for (std::size_t at = 0; at < kGroup; at += kLanes) {
    std::uint8_t bits[sizeof(Part)];
    hn::StoreMaskBits(Floats(), test(at), bits);
    group |= unsigned{std::bit_cast<Part>(bits)} << at;
  }
  return static_cast<std::uint16_t>(group);
}

// `sum` becomes no number where there is a null (and it may for infinite values, too).
HWY_INLINE std::uint16_t signs_of(const float* HWY_RESTRICT samples, Float level, Float& sum) {
  return group_of([&](std::size_t at) HWY_ATTR {
    const auto v = hn::LoadU(Floats(), samples + at);
    sum = hn::Add(sum, v);
    return hn::Ge(v, level);
  });
}
HWY_INLINE std::uint16_t known_of(const float* HWY_RESTRICT samples) {
  return group_of([&](std::size_t at) HWY_ATTR {
    const auto v = hn::LoadU(Floats(), samples + at);
    return hn::Eq(v, v);
  });
}

// The groups of a row that are wanted, ascending.
struct Groups {
  std::vector<std::uint32_t> places;
  std::size_t count = 0;
  bool all = false;
};

HWY_INLINE void put(std::uint16_t group, std::uint32_t place, std::uint64_t* row) {
  std::memcpy(reinterpret_cast<unsigned char*>(row) + 2 * std::size_t{place}, &group, sizeof(group));
}

void scan_row(const Frame& frame, const float* samples, const Groups& groups, const BitPlanes::Row& into,
              LinesAhead& ahead) {
  const auto level = hn::Set(Floats(), frame.isovalue);
  auto sum = hn::Zero(Floats());
  const float* const end = frame.values + frame.field->values.size();
  // The last group of the field's last row would be read from beyond the end.
  std::size_t whole = groups.count;
  while (whole > 0 && end - samples < static_cast<std::ptrdiff_t>(kGroup * (groups.places[whole - 1] + 1)))
    --whole;
  float last[kGroup] = {};
  if (whole < groups.count) {
    const float* const at = samples + kGroup * groups.places[whole];
    if (at < end) std::copy(at, end, last);
  }
  if (groups.all) {
    // The processor's own prefetching ends with each small page.
    constexpr std::ptrdiff_t kAhead = 384;
    for (std::size_t n = 0; n < whole; ++n) {
      const float* const at = samples + kGroup * groups.places[n];
      hwy::Prefetch(at + kAhead);
      put(signs_of(at, level, sum), groups.places[n], into.inside);
    }
  } else {
    // It does not see which groups are left out: the next plane wants the same ones, or nearly so.
    const float** const next = ahead.room(whole);
    for (std::size_t n = 0; n < whole; ++n) {
      const float* const at = samples + kGroup * groups.places[n];
      next[n] = at + frame.plane_step;
      put(signs_of(at, level, sum), groups.places[n], into.inside);
    }
    ahead.add(whole);
  }
  if (whole < groups.count) put(signs_of(last, level, sum), groups.places[whole], into.inside);
  *into.has_null = hn::AllTrue(Floats(), hn::Eq(sum, sum)) ? 0 : 1;
  if (HWY_LIKELY(*into.has_null == 0)) return;
  for (std::size_t n = 0; n < groups.count; ++n) {
    const std::uint32_t place = groups.places[n];
    put(known_of(n < whole ? samples + kGroup * place : last), place, into.known);
  }
}

// The rows of cells around a row of samples, each once.
struct Around {
  std::array<const std::uint64_t*, 4> masks{};
  friend bool operator==(const Around&, const Around&) = default;
};

Around around(const Frame& frame, const CellMasks& masks, std::int64_t p, std::int64_t r) {
  Around found;
  std::size_t count = 0;
  for (std::int64_t n = 0; n < 4; ++n) {
    const std::int64_t cell_p = p - (n & 1);
    const std::int64_t cell_r = r - (n >> 1);
    if (cell_p < 0 || cell_r < 0 || cell_p >= frame.cell_planes || cell_r >= frame.cell_rows) continue;
    const std::uint64_t* const mask = masks.row(cell_p, cell_r);
    if (mask != nullptr && std::find(found.masks.begin(), found.masks.end(), mask) == found.masks.end()) {
      found.masks[count++] = mask;
    }
  }
  return found;
}

void find_groups(const Frame& frame, const Around& cells, Groups& into) {
  into.places.resize(frame.words * (64 / kGroup) + 1);
  std::uint32_t* place = into.places.data();
  std::uint64_t before = 0;
  for (std::size_t w = 0; w < frame.words; ++w) {
    std::uint64_t cell = 0;
    for (const std::uint64_t* const mask : cells.masks) {
      if (mask != nullptr) cell |= mask[w];
    }
    const std::uint64_t samples = cell | cell << 1 | before;
    before = cell >> 63;
    for (std::uint32_t group = 0; group < 64 / kGroup; ++group) {
      *place = static_cast<std::uint32_t>(w * (64 / kGroup)) + group;
      place += (samples >> (kGroup * group) & 0xffff) != 0 ? 1 : 0;
    }
  }
  into.count = static_cast<std::size_t>(place - into.places.data());
  into.all = into.count * kGroup >= static_cast<std::size_t>(frame.row_step);
}

void scan_plane(const Frame& frame, const CellMasks& masks, std::int64_t p, BitPlanes& into,
                LinesAhead& ahead) {
  ahead.ask_all();
  Groups groups;
  Around before;
  for (std::int64_t r = 0; r < frame.sample_rows; ++r) {
    const Around here = around(frame, masks, p, r);
    if (here.masks[0] == nullptr) continue;
    if (here != before) find_groups(frame, here, groups);
    before = here;
    scan_row(frame, frame.samples(p, r), groups, into.row_to_scan(p, r), ahead);
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
      inside_(static_cast<std::size_t>(kPlanes * rows_) * words_ + kWordSlack + 1),
      known_(inside_.size()),
      has_null_(static_cast<std::size_t>(kPlanes * rows_)) {}

void BitPlanes::scan(const Frame& frame, const CellMasks& masks, std::int64_t p, LinesAhead& ahead) {
  if ((p == frame.cell_planes || masks.plane_is_empty(p)) && (p == 0 || masks.plane_is_empty(p - 1))) return;
  HWY_DYNAMIC_DISPATCH(scan_plane)(frame, masks, p, *this, ahead);
}

}  // namespace footwall::isosurface::detail
#endif
