// The decided cases in the form that the triangles are written from.
#pragma once
#include <array>
#include <cstdint>

#include "engine/isosurface/case_tables.h"

namespace footwall::isosurface::detail {

// The vertices of a cell at hand, by lane: 0, 4 the i edges 0 and 1, 1, 3 the j edges 4 and 5, 2, 5, 6, 7 the
// k edges 8..11; eight lanes on the edges of the first four whose k is one more: 2, 3, 6, 7; lane 10 the
// centre.
inline constexpr int kLanes = 16;
inline constexpr std::array<std::uint8_t, 13> kLaneOfEdge = {0, 4, 8, 12, 1, 3, 9, 11, 2, 5, 6, 7, 10};

// Its count is not known from the signs, or it does not fit into one vector.
inline constexpr std::uint8_t kSlow = 255;

// By corner bits in the order in which rows of bits give them: bit 2 n + side is the corner of row n at k +
// side, where n & 1 and n >> 1 are i and j.
struct CaseLookup {
  CaseLookup();

  // The lanes of the corners of up to five triangles; the last one is the number of triangles, or kSlow.
  alignas(64) std::array<std::array<std::uint8_t, kLanes>, 256> lanes;
  std::array<std::uint8_t, 256> signs;  // as case_tables.h counts corners
};

}  // namespace footwall::isosurface::detail
