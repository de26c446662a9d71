// The decided cases in the form that the triangles are written from.
#pragma once
#include <array>
#include <cstdint>

#include "engine/isosurface/case_tables.h"

namespace footwall::isosurface::detail {

// The vertices of a cell at hand, by lane: 0, 1 the i edges 0 and 1, 2, 3 the j edges 4 and 5, 4..7 the k
// edges 8..11, then from lane 8 on those of the first four whose k is one more: edges 2, 3, 6, 7; lane 12 the
// centre.
inline constexpr int kLanes = 16;
inline constexpr std::array<std::uint8_t, 13> kLaneOfEdge = {0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 6, 7, 12};

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
