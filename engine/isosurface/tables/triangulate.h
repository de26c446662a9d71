// Triangles that fill the loops of a cell.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/isosurface/tables/contours.h"

namespace footwall::isosurface::tables {

using Triangles = std::vector<std::array<int, 3>>;  // edges of the cell, or kCentreVertex

struct Filling {
  Triangles triangles;
  unsigned centre_edges = 0;  // bit e: the centre has an edge to the vertex on edge e; 0: no centre
};

// Every loop filled by a disc, or the two loops of the tunnel by one ring and the others by discs. Of all
// triangulations, with the vertices at the middle of their edges, that of the smallest area. No chord joins
// two vertices on a common face of the cell: the neighbour might have it too, and four triangles would meet
// there. Where none is left a centre vertex is added, one in a cell, and where that does not help either,
// chords on faces that the neighbour cannot have (may_be_chord). Nothing if all of that fails.
std::optional<Filling> fill(const Contours& contours, const std::optional<Tunnel>& tunnel);

// Every loop as a polygon fanned from its vertex with the lowest number.
Filling fan(const Contours& contours);

}  // namespace footwall::isosurface::tables
