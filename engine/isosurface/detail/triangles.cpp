// Compiled once per instruction set and chosen at run time; whole numbers only, alike on all of them.
#define HWY_WANT_AVX3_DL 1  // it counts the bits of eight words at once
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/triangles.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "engine/isosurface/detail/triangles.h"

#ifndef FOOTWALL_ISOSURFACE_SLOW_CELLS
#define FOOTWALL_ISOSURFACE_SLOW_CELLS
namespace footwall::isosurface::detail {

using CellIds = std::array<std::uint32_t, kLanes>;

// Where the next triangle goes.
struct TriangleWriter {
  std::uint32_t* at;
  std::uint32_t* end;
  const SlowCell* slow;
  std::vector<CentreLoop>* centres;
};

// Decides the cell; returns its triangles.
std::uint64_t count_slow_cell(const Frame& frame, std::int64_t p, std::int64_t r, std::int64_t k,
                              unsigned signs, std::vector<SlowCell>& slow);
void write_slow_cell(unsigned signs, const CellIds& ids, TriangleWriter& writer);

}  // namespace footwall::isosurface::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The signs of 64 samples, and of the one after, on the four rows of a row of cells.
struct CellSigns {
  std::array<std::uint64_t, 4> word;
  std::array<std::uint64_t, 4> next;

  // As CaseLookup counts them, of the cell k, 0..63.
  HWY_INLINE unsigned at(unsigned k) const {
    std::uint64_t bits = 0;
    if (k < 63) {
      for (unsigned n = 0; n < 4; ++n) bits |= (word[n] >> k & 3U) << (2 * n);
    } else {
      for (unsigned n = 0; n < 4; ++n) bits |= (word[n] >> 63 | (next[n] & 1U) << 1) << (2 * n);
    }
    return static_cast<unsigned>(bits);
  }
};

struct SignRows {
  SignRows(const Frame& frame, const BitPlanes& planes, std::int64_t p, std::int64_t r) {
    for (unsigned n = 0; n < 4; ++n) {
      rows[n] = planes.inside.data() + frame.row(p + (n & 1U), r + (n >> 1U)) * frame.words;
    }
  }
  HWY_INLINE CellSigns word(std::size_t w) const {
    CellSigns signs;
    for (unsigned n = 0; n < 4; ++n) {
      signs.word[n] = rows[n][w];
      signs.next[n] = rows[n][w + 1];
    }
    return signs;
  }
  std::array<const std::uint64_t*, 4> rows;
};

std::uint64_t count_plane(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases,
                          std::int64_t p, const ActiveCells& here, std::vector<SlowCell>& slow) {
  std::uint64_t count = 0;
  for (std::int64_t r = here.from; r < here.to; ++r) {
    if (here.any[static_cast<std::size_t>(r)] == 0) continue;
    const SignRows rows(frame, planes, p, r);
    const std::uint64_t* const words = here.words.data() + static_cast<std::size_t>(r) * frame.words;
    for (std::size_t w = 0; w < frame.words; ++w) {
      std::uint64_t active = words[w];
      if (active == 0) continue;
      const CellSigns signs = rows.word(w);
      for (; active != 0; active &= active - 1) {
        const auto k = static_cast<unsigned>(std::countr_zero(active));
        const unsigned bits = signs.at(k);
        const std::uint8_t triangles = cases.lanes[bits][kLanes - 1];
        if (triangles != kSlow) {
          count += triangles;
        } else {
          count +=
              count_slow_cell(frame, p, r, static_cast<std::int64_t>(64 * w + k), cases.signs[bits], slow);
        }
      }
    }
  }
  return count;
}

// The vertices of the cells of one word, in the lanes of CaseLookup (the centre's is left to others).
#if HWY_TARGET == HWY_AVX3_DL
class WordIds {
 public:
  WordIds(const std::uint64_t* masks, const std::uint32_t* firsts) : masks_(hn::Load(kWide, masks)) {
    const auto first = hn::Load(kHalf, firsts);
    firsts_ = hn::Combine(kNarrow, first, first);
  }
  HWY_INLINE void write(unsigned k, const std::array<std::uint8_t, kLanes>& lanes,
                        TriangleWriter& writer) const {
    const auto places = hn::PromoteTo(kNarrow, hn::Load(hn::Rebind<std::uint8_t, Narrow>(), lanes.data()));
    const auto corners =
        hn::TableLookupLanes(at(k), hn::IndicesFromVec(kNarrow, hn::And(places, hn::Set(kNarrow, 15))));
    const std::size_t count = 3 * std::size_t{lanes[kLanes - 1]};
    if (writer.end - writer.at >= kLanes) {
      hn::StoreU(corners, kNarrow, writer.at);  // what is too much is written over by the next cell
    } else {
      hn::BlendedStore(corners, hn::FirstN(kNarrow, count), kNarrow, writer.at);
    }
    writer.at += count;
  }
  HWY_INLINE void store(unsigned k, CellIds& ids) const { hn::StoreU(at(k), kNarrow, ids.data()); }

 private:
  using Narrow = hn::ScalableTag<std::uint32_t>;
  using Wide = hn::ScalableTag<std::uint64_t>;
  static constexpr Narrow kNarrow{};
  static constexpr hn::Half<Narrow> kHalf{};
  static constexpr Wide kWide{};
  static_assert(hn::MaxLanes(Narrow()) == kLanes);

  HWY_INLINE hn::Vec<Narrow> at(unsigned k) const {
    const std::uint64_t below = (std::uint64_t{1} << k) - 1;
    const auto lower = hn::PopulationCount(hn::And(masks_, hn::Set(kWide, below)));
    const auto upper = hn::PopulationCount(hn::And(masks_, hn::Set(kWide, below << 1 | 1)));
    return hn::Add(firsts_, hn::Combine(kNarrow, hn::TruncateTo(kHalf, upper), hn::TruncateTo(kHalf, lower)));
  }
  hn::Vec<Wide> masks_;
  hn::Vec<Narrow> firsts_;
};
#else
class WordIds {
 public:
  WordIds(const std::uint64_t* masks, const std::uint32_t* firsts) : masks_(masks), firsts_(firsts) {}
  HWY_INLINE void write(unsigned k, const std::array<std::uint8_t, kLanes>& lanes,
                        TriangleWriter& writer) const {
    CellIds ids;
    store(k, ids);
    const std::size_t count = 3 * std::size_t{lanes[kLanes - 1]};
    for (std::size_t n = 0; n < count; ++n) writer.at[n] = ids[lanes[n]];
    writer.at += count;
  }
  HWY_INLINE void store(unsigned k, CellIds& ids) const {
    const std::uint64_t below = (std::uint64_t{1} << k) - 1;
    for (unsigned n = 0; n < 8; ++n) {
      ids[n] = firsts_[n] + static_cast<std::uint32_t>(std::popcount(masks_[n] & below));
    }
    for (unsigned n = 0; n < 4; ++n) ids[8 + n] = ids[n] + static_cast<std::uint32_t>(masks_[n] >> k & 1U);
  }

 private:
  const std::uint64_t* masks_;
  const std::uint32_t* firsts_;
};
#endif

void write_plane(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases, const PlaneMasks& here,
                 const PlaneMasks& next, std::uint64_t first, std::uint64_t* HWY_RESTRICT row_first,
                 TriangleWriter& writer) {
  const std::uint32_t* const start = writer.at;
  std::fill(row_first, row_first + std::min(here.from, frame.cell_rows), first);
  for (std::int64_t r = here.from; r < std::min(here.to, frame.cell_rows); ++r) {
    row_first[r] = first + static_cast<std::uint64_t>(writer.at - start) / 3;
    const auto row = static_cast<std::size_t>(r);
    if (!here.counts[row].any) continue;
    std::uint32_t centre = here.counts[row].first_centre;
    const SignRows rows(frame, planes, here.p, r);
    const WordMasks* const here_0 = here.words.data() + row * frame.words;
    const WordMasks* const here_1 = here_0 + frame.words;
    const WordMasks* const next_0 = next.words.data() + row * frame.words;
    const WordMasks* const next_1 = next_0 + frame.words;
    for (std::size_t w = 0; w < frame.words; ++w) {
      std::uint64_t active = here_0[w].cells;
      if (active == 0) continue;
      const CellSigns signs = rows.word(w);
      alignas(64) const std::uint64_t masks[8] = {here_0[w].edges[0], here_1[w].edges[0], here_0[w].edges[1],
                                                  next_0[w].edges[1], here_0[w].edges[2], next_0[w].edges[2],
                                                  here_1[w].edges[2], next_1[w].edges[2]};
      alignas(64) const std::uint32_t firsts[8] = {here_0[w].first[0], here_1[w].first[0], here_0[w].first[1],
                                                   next_0[w].first[1], here_0[w].first[2], next_0[w].first[2],
                                                   here_1[w].first[2], next_1[w].first[2]};
      const WordIds ids(masks, firsts);
      for (; active != 0; active &= active - 1) {
        const auto k = static_cast<unsigned>(std::countr_zero(active));
        const unsigned bits = signs.at(k);
        const auto& lanes = cases.lanes[bits];
        if (HWY_LIKELY(lanes[kLanes - 1] != kSlow)) {
          ids.write(k, lanes, writer);
        } else {
          CellIds cell{};
          ids.store(k, cell);
          cell[kLaneOfEdge[kCentre]] = centre;
          if (writer.slow->has_centre) ++centre;
          write_slow_cell(cases.signs[bits], cell, writer);
        }
      }
    }
  }
  const std::int64_t after = std::min(std::max(here.to, here.from), frame.cell_rows);
  std::fill(row_first + after, row_first + frame.cell_rows,
            first + static_cast<std::uint64_t>(writer.at - start) / 3);
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(count_plane);
HWY_EXPORT(write_plane);

}  // namespace

std::uint64_t count_slow_cell(const Frame& frame, std::int64_t p, std::int64_t r, std::int64_t k,
                              unsigned signs, std::vector<SlowCell>& slow) {
  Alternative alternative = 0;
  if (is_undecided(signs)) {
    std::array<float, 8> values;
    for (unsigned c = 0; c < 8; ++c) {
      values[c] = frame.samples(p + (c & 1U), r + (c >> 1U & 1U))[k + (c >> 2U)];
    }
    alternative = decide(signs, values, frame.isovalue);
  }
  const Pattern& pattern = pattern_of(signs, alternative);
  slow.push_back(
      {static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(k), alternative, pattern.has_centre});
  return pattern.triangles.size();
}

void write_slow_cell(unsigned signs, const CellIds& ids, TriangleWriter& writer) {
  const SlowCell& cell = *writer.slow++;
  const Pattern& pattern = pattern_of(signs, cell.alternative);
  for (const auto& triangle : pattern.triangles) {
    for (const std::uint8_t edge : triangle) *writer.at++ = ids[kLaneOfEdge[edge]];
  }
  if (!pattern.has_centre) return;
  CentreLoop loop;
  loop.vertex = ids[kLaneOfEdge[kCentre]];
  for (unsigned edge = 0; edge < kCentre; ++edge) {
    if ((pattern.centre_edges >> edge & 1U) != 0) loop.around[loop.count++] = ids[kLaneOfEdge[edge]];
  }
  writer.centres->push_back(loop);
}

std::uint64_t count_triangles(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases,
                              std::int64_t p, const ActiveCells& here, std::vector<SlowCell>& slow) {
  return HWY_DYNAMIC_DISPATCH(count_plane)(frame, planes, cases, p, here, slow);
}

void count_centres(std::span<const SlowCell> slow, PlaneMasks& into) {
  for (const SlowCell& cell : slow) {
    if (cell.has_centre) ++into.counts[cell.r].centres;
  }
}

void write_triangles(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases,
                     const PlaneMasks& here, const PlaneMasks& next, std::span<const SlowCell> slow,
                     std::uint64_t first, std::span<Triangle> into, std::uint64_t* row_first,
                     std::vector<CentreLoop>& centres) {
  auto* const at = reinterpret_cast<std::uint32_t*>(into.data());
  TriangleWriter writer{at, at + 3 * into.size(), slow.data(), &centres};
  HWY_DYNAMIC_DISPATCH(write_plane)(frame, planes, cases, here, next, first, row_first, writer);
}

}  // namespace footwall::isosurface::detail
#endif
