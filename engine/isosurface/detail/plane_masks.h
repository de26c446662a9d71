// The active cells of a plane of cells, and the lattice edges of a plane of samples that the isosurface
// crosses, as bits.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/isosurface/detail/bit_planes.h"

namespace footwall::isosurface::detail {

// The cells of plane p that have triangles: corners on both sides, none of them null. Planes without cells
// (before the first, after the last) have none.
struct ActiveCells {
  explicit ActiveCells(const Frame& frame)
      : words(static_cast<std::size_t>(frame.cell_rows) * frame.words + kWordSlack),
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

// list_bits() (list_bits-inl.h) writes up to this many more than it says.
inline constexpr std::size_t kListSlack = 16;

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

// Both ask for lines `ahead` meanwhile.
// The planes p and p + 1 must be scanned.
void find_active(const Frame& frame, const CellMasks& masks, const BitPlanes& planes, std::int64_t p,
                 ActiveCells& into, LinesAhead& ahead);
// `before` and `here`: the active cells of planes p - 1 and p. Returns the number of crossed edges. first and
// centres are left alone.
std::uint64_t find_edges(const Frame& frame, const BitPlanes& planes, std::int64_t p,
                         const ActiveCells& before, const ActiveCells& here, PlaneMasks& into,
                         LinesAhead& ahead);
// Sets first and first_centre, from counts: the plane's vertices are `first_vertex` and on.
void number_vertices(const Frame& frame, std::uint64_t first_vertex, PlaneMasks& into);

}  // namespace footwall::isosurface::detail
