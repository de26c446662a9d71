// How a triangulated patch would look: its area, and whether it cuts itself.
#pragma once
#include <array>
#include <optional>
#include <vector>

namespace footwall::isosurface::tables {

using Triangles = std::vector<std::array<int, 3>>;  // edges of the cell, or kCentreVertex
using Vector = std::array<double, 3>;
using Places = std::array<Vector, 13>;  // of the edges' vertices, and of the centre

// In the middle of the edges, or, where a tunnel joins corners of one sign, a third of the edge from the
// other end: only then is there room for it. The centre is left out.
Places places_of(unsigned signs, std::optional<bool> joins_inside);

// Bit e: the centre has an edge to the vertex on edge e.
unsigned vertices_beside_centre(const Triangles& triangles);
// With the centre in the mean of the vertices beside it.
Places with_centre(Places places, unsigned beside);

double area(const Triangles& triangles, const Places& places);

// No triangle without area, none folded back on its neighbour, none cut by the edge of another.
bool is_embedded(const Triangles& triangles, const Places& places);

}  // namespace footwall::isosurface::tables
