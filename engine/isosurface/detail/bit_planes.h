// A bit for every sample: whether it is inside.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/detail/cell_masks.h"
#include "engine/isosurface/page_vector.h"

namespace footwall::isosurface::detail {

// Rows as frame.row() numbers them, frame.words words each. Only words with samples of cells to be looked at
// are written, of the others nothing is known.
struct BitPlanes {
  PageVector<std::uint64_t> inside;    // v >= isovalue; one word more than the rows have
  PageVector<std::uint64_t> known;     // not null; written in rows that have a null only
  std::vector<std::uint8_t> has_null;  // per row
};

void find_signs(const Frame& frame, const CellMasks& masks, int threads, BitPlanes& into);

}  // namespace footwall::isosurface::detail
