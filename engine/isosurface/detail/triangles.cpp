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

// The two signs at k and k + 1.
HWY_INLINE unsigned pair_at(const std::uint64_t* row, std::uint32_t k) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, reinterpret_cast<const unsigned char*>(row) + (k >> 3), sizeof(bits));
  return bits >> (k & 7U) & 3U;
}

std::uint64_t count_plane(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases,
                          std::int64_t p, ActiveCells& here, std::vector<SlowCell>& slow) {
  std::uint64_t count = 0;
  for (std::int64_t r = here.from; r < here.to; ++r) {
    const std::uint64_t* const rows[4] = {planes.inside(p, r), planes.inside(p + 1, r),
                                          planes.inside(p, r + 1), planes.inside(p + 1, r + 1)};
    const std::size_t end = here.first[static_cast<std::size_t>(r) + 1];
    for (std::size_t n = here.first[static_cast<std::size_t>(r)]; n < end; ++n) {
      const std::uint32_t k = here.cells[n];
      const unsigned bits = pair_at(rows[0], k) | pair_at(rows[1], k) << 2 | pair_at(rows[2], k) << 4 |
                            pair_at(rows[3], k) << 6;
      here.bits[n] = static_cast<std::uint8_t>(bits);
      const std::uint8_t triangles = cases.lanes[bits][kLanes - 1];
      count += HWY_LIKELY(triangles != kSlow) ? triangles
                                              : count_slow_cell(frame, p, r, k, cases.signs[bits], slow);
    }
  }
  return count;
}

// The masks of the words of a cell's four rows of samples: lower and upper plane, row r and r + 1.
struct CellWords {
  const WordMasks* lower_0;
  const WordMasks* lower_1;
  const WordMasks* upper_0;
  const WordMasks* upper_1;
};

#if HWY_TARGET == HWY_AVX3_DL
using Narrow = hn::ScalableTag<std::uint32_t>;
using Wide = hn::ScalableTag<std::uint64_t>;
static_assert(hn::MaxLanes(Narrow()) == kLanes);

// Eight of the lanes {lower_0, lower_1} and {upper_0, upper_1}: those of the first but 3, 5 and 7, which are
// 1, 2 and 6 of the second.
template <class D, class T>
HWY_INLINE hn::Vec<D> merged(D d, const T* lower_0, const T* lower_1, const T* upper_0, const T* upper_1) {
  const hn::Half<D> half;
  alignas(64) static constexpr T kFrom[8] = {0, 0, 0, 1, 0, 2, 0, 6};
  const auto from = hn::Load(d, kFrom);
  const auto lower = hn::Combine(d, hn::LoadU(half, lower_1), hn::LoadU(half, lower_0));
  const auto upper = hn::Combine(d, hn::LoadU(half, upper_1), hn::LoadU(half, upper_0));
  return hn::IfThenElse(hn::Eq(from, hn::Zero(d)), lower,
                        hn::TableLookupLanes(upper, hn::IndicesFromVec(d, from)));
}

// The vertices of a cell, in the lanes of CaseLookup, but for the centre.
HWY_INLINE hn::Vec<Narrow> cell_ids(const CellWords& words, std::uint32_t k) {
  const Narrow narrow;
  const hn::Half<Narrow> half;
  const Wide wide;
  const auto masks = merged(wide, words.lower_0->edges.data(), words.lower_1->edges.data(),
                            words.upper_0->edges.data(), words.upper_1->edges.data());
  const auto firsts = merged(half, words.lower_0->first.data(), words.lower_1->first.data(),
                             words.upper_0->first.data(), words.upper_1->first.data());
  const std::uint64_t below = (std::uint64_t{1} << (k & 63U)) - 1;
  const auto at_k = hn::PopulationCount(hn::And(masks, hn::Set(wide, below)));
  const auto above_k = hn::PopulationCount(hn::And(masks, hn::Set(wide, below << 1 | 1)));
  return hn::Combine(narrow, hn::Add(firsts, hn::TruncateTo(half, above_k)),
                     hn::Add(firsts, hn::TruncateTo(half, at_k)));
}
HWY_INLINE void store_ids(const CellWords& words, std::uint32_t k, CellIds& ids) {
  hn::StoreU(cell_ids(words, k), Narrow(), ids.data());
}

HWY_INLINE void write_cell(const CellWords& words, std::uint32_t k,
                           const std::array<std::uint8_t, kLanes>& lanes, TriangleWriter& writer) {
  const Narrow narrow;
  const auto places = hn::PromoteTo(narrow, hn::Load(hn::Rebind<std::uint8_t, Narrow>(), lanes.data()));
  const auto corners = hn::TableLookupLanes(cell_ids(words, k), hn::IndicesFromVec(narrow, places));
  const std::size_t count = 3 * std::size_t{lanes[kLanes - 1]};
  if (HWY_LIKELY(writer.end - writer.at >= kLanes)) {
    hn::StoreU(corners, narrow, writer.at);  // what is too much is written over by the next cell
  } else {
    hn::BlendedStore(corners, hn::FirstN(narrow, count), narrow, writer.at);
  }
  writer.at += count;
}
#else
HWY_INLINE void store_ids(const CellWords& words, std::uint32_t k, CellIds& ids) {
  const std::uint64_t below = (std::uint64_t{1} << (k & 63U)) - 1;
  const auto number = [&](const WordMasks* word, std::size_t axis) {
    return word->first[axis] + static_cast<std::uint32_t>(std::popcount(word->edges[axis] & below));
  };
  const auto above = [&](const WordMasks* word, std::size_t axis) {
    return static_cast<std::uint32_t>(word->edges[axis] >> (k & 63U) & 1U);
  };
  ids[0] = number(words.lower_0, 0);
  ids[1] = number(words.lower_0, 1);
  ids[2] = number(words.lower_0, 2);
  ids[3] = number(words.upper_0, 1);
  ids[4] = number(words.lower_1, 0);
  ids[5] = number(words.upper_0, 2);
  ids[6] = number(words.lower_1, 2);
  ids[7] = number(words.upper_1, 2);
  ids[8] = ids[0] + above(words.lower_0, 0);
  ids[9] = ids[1] + above(words.lower_0, 1);
  ids[11] = ids[3] + above(words.upper_0, 1);
  ids[12] = ids[4] + above(words.lower_1, 0);
}

HWY_INLINE void write_cell(const CellWords& words, std::uint32_t k,
                           const std::array<std::uint8_t, kLanes>& lanes, TriangleWriter& writer) {
  CellIds ids;
  store_ids(words, k, ids);
  const std::size_t count = 3 * std::size_t{lanes[kLanes - 1]};
  for (std::size_t n = 0; n < count; ++n) writer.at[n] = ids[lanes[n]];
  writer.at += count;
}
#endif

void write_plane(const Frame& frame, const CaseLookup& cases, const ActiveCells& cells,
                 const PlaneMasks& lower, const PlaneMasks& upper, std::uint64_t first,
                 std::uint64_t* HWY_RESTRICT row_first, TriangleWriter& writer) {
  const std::uint32_t* const start = writer.at;
  const std::int64_t from = std::min(cells.from, frame.cell_rows);
  std::fill(row_first, row_first + from, first);
  for (std::int64_t r = from; r < cells.to; ++r) {
    row_first[r] = first + static_cast<std::uint64_t>(writer.at - start) / 3;
    const auto row = static_cast<std::size_t>(r);
    std::uint32_t centre = lower.counts[row].first_centre;
    const WordMasks* const lower_words = lower.words.data() + row * frame.words;
    const WordMasks* const upper_words = upper.words.data() + row * frame.words;
    for (std::size_t n = cells.first[row]; n < cells.first[row + 1]; ++n) {
      const std::uint32_t k = cells.cells[n];
      const std::size_t w = k >> 6;
      const CellWords words{lower_words + w, lower_words + w + frame.words, upper_words + w,
                            upper_words + w + frame.words};
      const auto& lanes = cases.lanes[cells.bits[n]];
      if (HWY_LIKELY(lanes[kLanes - 1] != kSlow)) {
        write_cell(words, k, lanes, writer);
      } else {
        CellIds ids{};
        store_ids(words, k, ids);
        ids[kLaneOfEdge[kCentre]] = centre;
        if (writer.slow->has_centre) ++centre;
        write_slow_cell(cases.signs[cells.bits[n]], ids, writer);
      }
    }
  }
  std::fill(row_first + std::max(cells.to, from), row_first + frame.cell_rows,
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
                              std::int64_t p, ActiveCells& here, std::vector<SlowCell>& slow) {
  here.bits.resize(std::max(here.bits.size(), here.cells.size()));
  return HWY_DYNAMIC_DISPATCH(count_plane)(frame, planes, cases, p, here, slow);
}

void list_part_runs(const Frame& frame, const CaseLookup& cases, const ActiveCells& cells, std::int64_t p,
                    std::span<const SlowCell> slow, std::uint64_t first, std::vector<PartRun>& into) {
  const survey::Index& origin = frame.field->origin;
  const std::int64_t i = p + frame.cells.lo[0] + origin[0];
  const SlowCell* next_slow = slow.data();
  for (std::int64_t r = cells.from; r < cells.to; ++r) {
    const auto row = static_cast<std::size_t>(r);
    const std::int64_t j = r + frame.cells.lo[1] + origin[1];
    std::int64_t part = -1;
    for (std::size_t n = cells.first[row]; n < cells.first[row + 1]; ++n) {
      const std::int64_t here = (static_cast<std::int64_t>(cells.cells[n]) + origin[2]) >> 1;
      if (here != part) into.push_back({first, i, j, here});
      part = here;
      const std::uint8_t count = cases.lanes[cells.bits[n]][kLanes - 1];
      if (count != kSlow) {
        first += count;
      } else {
        first += pattern_of(cases.signs[cells.bits[n]], (next_slow++)->alternative).triangles.size();
      }
    }
  }
}

std::uint64_t count_centres(std::span<const SlowCell> slow, PlaneMasks& into) {
  std::uint64_t count = 0;
  for (const SlowCell& cell : slow) {
    if (!cell.has_centre) continue;
    ++into.counts[cell.r].centres;
    ++count;
  }
  return count;
}

void write_triangles(const Frame& frame, const CaseLookup& cases, const ActiveCells& cells,
                     const PlaneMasks& lower, const PlaneMasks& upper, std::span<const SlowCell> slow,
                     std::uint64_t first, std::span<Triangle> into, std::uint64_t* row_first,
                     std::vector<CentreLoop>& centres) {
  auto* const at = reinterpret_cast<std::uint32_t*>(into.data());
  TriangleWriter writer{at, at + 3 * into.size(), slow.data(), &centres};
  HWY_DYNAMIC_DISPATCH(write_plane)(frame, cases, cells, lower, upper, first, row_first, writer);
}

}  // namespace footwall::isosurface::detail
#endif
