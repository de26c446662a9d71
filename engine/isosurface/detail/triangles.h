// From active cells to triangles: counted in one pass, written in another.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/detail/case_lookup.h"
#include "engine/isosurface/detail/plane_masks.h"
#include "engine/isosurface/extract.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface::detail {

// A cell for which the signs are not enough, or with a centre vertex; in the order of the cells.
struct SlowCell {
  std::uint32_t r = 0;
  std::uint32_t k = 0;
  Alternative alternative = 0;
  bool has_centre = false;
};

// A centre vertex and the vertices it is the mean of.
struct CentreLoop {
  std::uint32_t vertex = 0;
  std::uint32_t count = 0;
  std::array<std::uint32_t, 12> around{};
};

// Of the cells of plane p, whose corner bits are noted; slow cells are added.
std::uint64_t count_triangles(const Frame& frame, const BitPlanes& planes, const CaseLookup& cases,
                              std::int64_t p, ActiveCells& here, std::vector<SlowCell>& slow);

// Where the triangles of each two cells along samples stand, for cells that count_triangles() has
// seen; `first`: the number of the plane's first triangle.
void list_part_runs(const Frame& frame, const CaseLookup& cases, const ActiveCells& cells, std::int64_t p,
                    std::span<const SlowCell> slow, std::uint64_t first, std::vector<PartRun>& into);

// Sets counts[].centres of the plane that the cells belong to; returns their sum.
std::uint64_t count_centres(std::span<const SlowCell> slow, PlaneMasks& into);

// Writes the triangles of the counted cells between the planes of samples `lower` and `upper`, number `first`
// and on, into `into`, which has exactly room for them, and the first of each row, from cell row 0 on, into
// row_first. The loops of centres are added.
void write_triangles(const Frame& frame, const CaseLookup& cases, const ActiveCells& cells,
                     const PlaneMasks& lower, const PlaneMasks& upper, std::span<const SlowCell> slow,
                     std::uint64_t first, std::span<Triangle> into, std::uint64_t* row_first,
                     std::vector<CentreLoop>& centres);

}  // namespace footwall::isosurface::detail
