// The triangles of a rank's pieces in the order of the whole surface.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/parallel/number_runs.h"
#include "engine/isosurface/parallel/piece.h"
#include "engine/isosurface/parallel/pillars.h"

namespace footwall::isosurface::detail {

inline constexpr std::uint32_t kNoRow = 0xffffffffU;

// Triangles that follow each other in a piece, and do so in the whole.
struct Stretch {
  Run run;
  std::uint32_t piece = 0;
  std::uint32_t row = kNoRow;  // of the piece's cells; none for triangles of a cap
  std::uint64_t first = 0;     // triangle of the piece
};

// One for each row of a piece that has triangles, by row (i, j) and then by sample; after them the triangles
// of caps by row, sample and face, one by one. Caps need keys.
std::vector<Stretch> stretches_of(const Pillars& pillars, std::span<const Piece> pieces);
std::uint64_t triangle_slots(const Pillars& pillars);

}  // namespace footwall::isosurface::detail
