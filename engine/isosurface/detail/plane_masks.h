// The active cells of a plane of cells, and the lattice edges of a plane of samples that the isosurface
// crosses, as bits.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/isosurface/detail/bit_planes.h"

namespace footwall::isosurface::detail {

// The cells of plane p that have triangles: corners on both sides, none of them null. Planes without cells
// (before the first, after the last) have none.
struct ActiveCells {
  explicit ActiveCells(const Frame& frame)
      : words(static_cast<std::size_t>(frame.cell_rows) * frame.words),
        first(static_cast<std::size_t>(frame.cell_rows) + 1) {}

  std::int64_t from = 0;  // the rows outside [from, to) have none, and their entries mean nothing
  std::int64_t to = 0;
  std::vector<std::uint64_t> words;  // a bit per cell, [r][word]; of rows that have none nothing is known
  std::vector<std::uint32_t> cells;  // the k of the cells, row by row
  std::vector<std::size_t> first;    // row r has cells[first[r]] .. cells[first[r + 1]]
  std::vector<std::uint8_t> bits;    // per cell, as CaseLookup counts corners; see count_triangles()
};

// 64 samples of a row: bit k of edges[axis] is the edge from sample k along the axis.
struct WordMasks {
  std::array<std::uint64_t, 3> edges{};
  std::array<std::uint32_t, 3> first{};  // number of the vertex of the lowest bit of each
  std::uint32_t unused = 0;              // so that vectors of four can be read from both
};

// Writes the places of the bits, ascending, `first` for bit 0, and returns where the next one goes; writes up
// to three more than there are.
template <class Number>
inline Number* list_bits(std::uint64_t bits, Number first_place, Number* into) {
  Number* const end = into + std::popcount(bits);
  // Most words have few: four at a time, without asking how many there are, spare mispredicted branches.
  while (true) {
    for (int n = 0; n < 4; ++n) {
      into[n] = first_place + static_cast<Number>(std::countr_zero(bits));
      bits &= bits - 1;
    }
    if (bits == 0) return end;
    into += 4;
  }
}
inline constexpr std::size_t kListSlack = 4;

struct PlaneMasks {
  explicit PlaneMasks(const Frame& frame)
      : words(static_cast<std::size_t>(frame.sample_rows) * frame.words),
        counts(static_cast<std::size_t>(frame.sample_rows)) {}

  struct RowCounts {
    bool any = false;  // whether cells around have triangles: else nothing else is written
    std::array<std::uint32_t, 3> edges{};  // crossed, per axis
    std::uint32_t centres = 0;
    std::uint32_t first_centre = 0;  // number of the first centre vertex
  };
  std::int64_t p = 0;
  std::int64_t from = 0;  // as in ActiveCells
  std::int64_t to = 0;
  std::vector<WordMasks> words;  // [r][word]
  std::vector<RowCounts> counts;
};

// The planes p and p + 1 must be scanned.
void find_active(const Frame& frame, const CellMasks& masks, const BitPlanes& planes, std::int64_t p,
                 ActiveCells& into);
// `before` and `here`: the active cells of planes p - 1 and p. Returns the number of crossed edges. first and
// centres are left alone.
std::uint64_t find_edges(const Frame& frame, const BitPlanes& planes, std::int64_t p,
                         const ActiveCells& before, const ActiveCells& here, PlaneMasks& into);
// Sets first and first_centre, from counts: the plane's vertices are `first_vertex` and on.
void number_vertices(const Frame& frame, std::uint64_t first_vertex, PlaneMasks& into);

}  // namespace footwall::isosurface::detail
