// The surface of a small field cell by cell, as places of the lattice without positions, and what form it
// has. Slow and plain: it shares nothing with the extraction but the rules of the cells.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/field.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

using KeyTriangle = std::array<VertexKey, 3>;

// In the order of Surface::triangles. A cell with a NaN has none.
std::vector<KeyTriangle> triangles_by_cell(const Field& field, float isovalue,
                                           const CaseRules& rules = trilinear_rules());

struct SurfaceForm {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t components = 0;     // of triangles that share a vertex
  std::int64_t euler = 0;          // vertices - edges + triangles
  std::int64_t genus = 0;          // handles of all components; meaningless where an edge is crowded
  std::int64_t border_edges = 0;   // with one triangle, on the border of the volume
  std::int64_t open_edges = 0;     // with one triangle, elsewhere: a crack, or beside a null
  std::int64_t crowded_edges = 0;  // with more than two triangles
  std::int64_t twisted_edges = 0;  // with two triangles that run them in the same direction
};
SurfaceForm form_of(std::span<const KeyTriangle> triangles, const survey::Index& volume_size);

}  // namespace footwall::isosurface
