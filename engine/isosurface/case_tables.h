// Which triangles a cell has. The patterns are made by a program in the build (tables/), which checks every
// one of them.
// Based on: seed 000, section 3 (all 256 cases listed by a program); Chernyaev, Marching Cubes 33, 1995;
// differs in that the interior is decided as the trilinear field does (Custodio and others, 2013).
//
// Corner c of a cell is its sample (c & 1, c >> 1 & 1, c >> 2 & 1); bit c of `signs` is set where the value
// is at or above the isovalue. Edge 4 * axis + n runs along `axis` from the corner whose coordinates on the
// two other axes, in ascending order of axes, are n & 1 and n >> 1. Number 12 is the cell's centre vertex.
// Face 2 * axis + side.
#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace footwall::isosurface {

inline constexpr int kCentre = 12;

// How an undecided cell is decided: bit f: on the ambiguous face f the corners at or above the isovalue are
// joined; bit 6: inside the cell a tunnel joins what the faces keep apart. 0 for a cell without ambiguity.
using Alternative = std::uint8_t;

struct Pattern {
  std::span<const std::array<std::uint8_t, 3>>
      triangles;  // edges 0..11 or kCentre; see Surface for the winding
  bool has_centre = false;
  // The loop that the centre vertex fills: bit e: the vertex on edge e. It stands at their mean, and its
  // normal is their mean, made a unit vector.
  std::uint16_t centre_edges = 0;
};

// Whether more than the signs decide: an ambiguous face, or an ambiguous interior.
bool is_undecided(unsigned signs);
// The pattern of signs 0..255. Asking for an alternative that the signs cannot have is a broken precondition
// (assert).
const Pattern& pattern_of(unsigned signs, Alternative alternative = 0);
// The alternative of a cell whose corners have these values, none of them NaN. The same for the cells on both
// sides of a face, exactly: signs of products are taken without rounding errors. A saddle at the isovalue
// joins the corners at or above it.
Alternative decide(unsigned signs, const std::array<float, 8>& values, float isovalue);

}  // namespace footwall::isosurface
