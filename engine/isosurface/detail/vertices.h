// From crossed edges to vertices: first listed, then made many at a time.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/detail/triangles.h"

namespace footwall::isosurface::detail {

// The vertices of one plane of samples, in the order of Surface. Centres stand in it as placeholders, at
// their cell's lower corner: write_vertices() makes something of them that is to be written over.
struct VertexList {
  std::vector<std::int32_t> offset;  // of the edge's lower sample from the plane's first sample
  std::vector<std::int32_t> place;   // 4 * j + axis of the field's row j; axis 3: a centre
  std::size_t count = 0;
};

// `slow`: the slow cells of the plane of cells here.p.
void list_vertices(const Frame& frame, const PlaneMasks& here, std::span<const SlowCell> slow,
                   VertexList& into);

// normals and keys may be null; else room for list.count each. Asks for lines `ahead` meanwhile.
void write_vertices(const Frame& frame, std::int64_t p, const VertexList& list, Point* positions,
                    Point* normals, VertexKey* keys, LinesAhead& ahead);

// Each centre from the vertices around it, which must be made.
void write_centres(std::span<const CentreLoop> centres, Point* positions, Point* normals);

}  // namespace footwall::isosurface::detail
