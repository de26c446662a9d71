// Compiled once per instruction set and chosen at run time: counting bits is one instruction on most of them.
#define HWY_WANT_AVX3_DL 1  // it lists the bits of a word at once
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/plane_masks.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "engine/isosurface/detail/list_bits-inl.h"
#include "engine/isosurface/detail/plane_masks.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The word that holds for each bit the one above it.
HWY_INLINE std::uint64_t upper(std::uint64_t word, std::uint64_t next) {
  return word >> 1 | next << 63;
}

// rows[c]: the signs of the samples (p + (c & 1), r + (c >> 1)). Returns the OR of what is written. Up to
// kWordSlack words more are read, and written.
HWY_INLINE bool mixed_cells(const std::uint64_t* const* rows, const std::uint64_t* HWY_RESTRICT mask,
                            std::size_t words, std::uint64_t* HWY_RESTRICT into) {
  const hn::ScalableTag<std::uint64_t> d;
  static_assert(hn::MaxLanes(hn::ScalableTag<std::uint64_t>()) <= kWordSlack);
  auto all = hn::Zero(d);
  for (std::size_t w = 0; w < words; w += hn::Lanes(d)) {
    auto some = hn::Zero(d);
    auto next_some = hn::Zero(d);
    auto every = hn::Not(some);
    auto next_every = every;
    for (int c = 0; c < 4; ++c) {
      const auto here = hn::LoadU(d, rows[c] + w);
      const auto next = hn::LoadU(d, rows[c] + w + 1);
      some = hn::Or(some, here);
      every = hn::And(every, here);
      next_some = hn::Or(next_some, next);
      next_every = hn::And(next_every, next);
    }
    some = hn::Or(some, hn::Or(hn::ShiftRight<1>(some), hn::ShiftLeft<63>(next_some)));
    every = hn::And(every, hn::Or(hn::ShiftRight<1>(every), hn::ShiftLeft<63>(next_every)));
    const auto active = hn::And(hn::AndNot(every, some), hn::LoadU(d, mask + w));
    hn::StoreU(active, d, into + w);
    all = hn::Or(all, hn::IfThenElseZero(hn::FirstN(d, words - w), active));
  }
  return !hn::AllTrue(d, hn::Eq(all, hn::Zero(d)));
}

// Whether the row has active cells.
bool active_row(const Frame& frame, const std::uint64_t* mask, const BitPlanes& planes, std::int64_t p,
                std::int64_t r, std::uint64_t* words) {
  const std::uint64_t* const rows[4] = {planes.inside(p, r), planes.inside(p + 1, r), planes.inside(p, r + 1),
                                        planes.inside(p + 1, r + 1)};
  bool any = mixed_cells(rows, mask, frame.words, words);
  for (std::int64_t c = 0; c < 4 && any; ++c) {
    if (!planes.has_null(p + (c & 1), r + (c >> 1))) continue;
    const std::uint64_t* const known = planes.known(p + (c & 1), r + (c >> 1));
    any = false;
    for (std::size_t w = 0; w < frame.words; ++w) {
      words[w] &= known[w] & upper(known[w], known[w + 1]);
      any = any || words[w] != 0;
    }
  }
  return any;
}

void active_plane(const Frame& frame, const CellMasks& masks, const BitPlanes& planes, std::int64_t p,
                  ActiveCells& into, LinesAhead& ahead) {
  into.from = frame.cell_rows;
  into.to = 0;
  std::size_t count = 0;
  for (std::int64_t r = 0; r < frame.cell_rows; ++r) {
    const auto place = static_cast<std::size_t>(r);
    into.first[place] = count;
    const std::uint64_t* const mask = masks.row(p, r);
    std::uint64_t* const words = into.words.data() + place * frame.words;
    if (mask == nullptr) continue;
    ahead.ask(1);
    if (!active_row(frame, mask, planes, p, r, words)) continue;
    into.from = std::min(into.from, r);
    into.to = r + 1;
    if (into.cells.size() < count + 64 * frame.words + kListSlack) {
      into.cells.resize(2 * count + 64 * frame.words + kListSlack);
    }
    std::uint32_t* cells = into.cells.data() + count;
    for (std::size_t w = 0; w < frame.words; ++w) {
      cells = list_bits(words[w], static_cast<std::uint32_t>(64 * w), cells);
    }
    count = static_cast<std::size_t>(cells - into.cells.data());
  }
  into.first.back() = count;
}

std::uint64_t edge_plane(const Frame& frame, const BitPlanes& planes, std::int64_t p,
                         const ActiveCells& before, const ActiveCells& here,
                         const std::uint64_t* HWY_RESTRICT none, PlaneMasks& into, LinesAhead& ahead) {
  std::uint64_t crossed = 0;
  // Cells of the row r of a plane of cells.
  const auto cells_of_row = [&](const ActiveCells& plane, std::int64_t r) {
    if (r < plane.from || r >= plane.to) return none;
    const auto row = static_cast<std::size_t>(r);
    if (plane.first[row] == plane.first[row + 1]) return none;
    return plane.words.data() + static_cast<std::size_t>(r) * frame.words;
  };
  into.from = frame.sample_rows;
  into.to = 0;
  for (const ActiveCells* const cells : {&before, &here}) {
    if (cells->from >= cells->to) continue;
    into.from = std::min(into.from, cells->from);
    into.to = std::max(into.to, cells->to + 1);
  }
  for (std::int64_t r = into.from; r < into.to; ++r) {
    PlaneMasks::RowCounts& counts = into.counts[static_cast<std::size_t>(r)];
    const std::uint64_t* const here_here = cells_of_row(here, r);
    const std::uint64_t* const here_before = cells_of_row(here, r - 1);
    const std::uint64_t* const before_here = cells_of_row(before, r);
    const std::uint64_t* const before_before = cells_of_row(before, r - 1);
    counts = {};
    counts.any = here_here != none || here_before != none || before_here != none || before_before != none;
    if (!counts.any) continue;
    ahead.ask(1);
    // An edge beyond the frame has no cells around it, so any signs will do for its upper end.
    const std::uint64_t* const signs = planes.inside(p, r);
    const std::uint64_t* const signs_j = r < frame.cell_rows ? planes.inside(p, r + 1) : signs;
    const std::uint64_t* const signs_i = p < frame.cell_planes ? planes.inside(p + 1, r) : signs;
    WordMasks* const words = into.words.data() + static_cast<std::size_t>(r) * frame.words;
    std::uint64_t carry_j = 0;  // whether the cell below the word has the edge, too
    std::uint64_t carry_i = 0;
    for (std::size_t w = 0; w < frame.words; ++w) {
      const std::uint64_t around_j = here_here[w] | before_here[w];
      const std::uint64_t around_i = here_here[w] | here_before[w];
      const std::uint64_t around_k = around_j | here_before[w] | before_before[w];
      WordMasks& word = words[w];
      if ((around_k | carry_j | carry_i) == 0) {
        word.edges = {};
      } else {
        const std::uint64_t sign = signs[w];
        word.edges[0] = (sign ^ signs_i[w]) & (around_i | around_i << 1 | carry_i);
        word.edges[1] = (sign ^ signs_j[w]) & (around_j | around_j << 1 | carry_j);
        word.edges[2] = (sign ^ upper(sign, signs[w + 1])) & around_k;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          counts.edges[axis] += static_cast<std::uint32_t>(std::popcount(word.edges[axis]));
        }
      }
      carry_j = around_j >> 63;
      carry_i = around_i >> 63;
    }
    crossed += std::uint64_t{counts.edges[0]} + counts.edges[1] + counts.edges[2];
  }
  return crossed;
}

void number_plane(const Frame& frame, std::uint64_t first_vertex, PlaneMasks& into) {
  auto next = static_cast<std::uint32_t>(first_vertex);
  for (std::int64_t r = into.from; r < into.to; ++r) {
    PlaneMasks::RowCounts& counts = into.counts[static_cast<std::size_t>(r)];
    if (!counts.any) continue;
    std::array<std::uint32_t, 3> first{};
    for (const std::size_t axis : {2U, 1U, 0U}) {
      first[axis] = next;
      next += counts.edges[axis];
    }
    counts.first_centre = next;
    next += counts.centres;
    WordMasks* const words = into.words.data() + static_cast<std::size_t>(r) * frame.words;
    for (std::size_t w = 0; w < frame.words; ++w) {
      words[w].first = first;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] += static_cast<std::uint32_t>(std::popcount(words[w].edges[axis]));
      }
    }
  }
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(active_plane);
HWY_EXPORT(edge_plane);
HWY_EXPORT(number_plane);

}  // namespace

void find_active(const Frame& frame, const CellMasks& masks, const BitPlanes& planes, std::int64_t p,
                 ActiveCells& into, LinesAhead& ahead) {
  if (p < 0 || p >= frame.cell_planes || masks.plane_is_empty(p)) {
    into.from = into.to = 0;
    return;
  }
  HWY_DYNAMIC_DISPATCH(active_plane)(frame, masks, planes, p, into, ahead);
}

std::uint64_t find_edges(const Frame& frame, const BitPlanes& planes, std::int64_t p,
                         const ActiveCells& before, const ActiveCells& here, PlaneMasks& into,
                         LinesAhead& ahead) {
  into.p = p;
  const std::vector<std::uint64_t> none(frame.words, 0);
  return HWY_DYNAMIC_DISPATCH(edge_plane)(frame, planes, p, before, here, none.data(), into, ahead);
}

void number_vertices(const Frame& frame, std::uint64_t first_vertex, PlaneMasks& into) {
  HWY_DYNAMIC_DISPATCH(number_plane)(frame, first_vertex, into);
}

}  // namespace footwall::isosurface::detail
#endif
