// Where the surface meets the faces of a cell, and which of its loops a tunnel can join.
#pragma once
#include <array>
#include <vector>

namespace footwall::isosurface::tables {

// Edges of the cell, in the direction in which the patch that fills the loop is counter-clockwise as seen
// from the outside of the surface: on a face seen from outside the cell the inside corners lie to the right.
using Loop = std::vector<int>;

struct Contours {
  std::vector<Loop> loops;
  // Corners with the same number hang together on the faces of the cell; inside and outside ones never do.
  std::array<int, 8> group{};
};

// Bit f of `joined`: on the ambiguous face f the inside corners are joined.
Contours trace(unsigned signs, unsigned joined);

// Two loops that one surface can join, so that two groups are joined through the cell.
struct Tunnel {
  bool inside = false;  // the groups joined are of inside corners
  int from = 0;         // loops
  int to = 0;
};

// The tunnels that a trilinear field with these signs and faces can have, by what follows from its slices
// (docs/isosurface-cases.md): at most one of inside and one of outside corners.
std::vector<Tunnel> tunnels(unsigned signs, unsigned joined, const Contours& contours);

}  // namespace footwall::isosurface::tables
