// Marching cubes in some cells of the octree.
#pragma once
#include <span>
#include <vector>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/extract.h"
#include "engine/isosurface/visible/paper/triangle_order.h"
#include "engine/render/lit_surface.h"

namespace footwall::isosurface {

// Some of a surface's triangles.
struct SomeTriangles {
  Surface surface;  // rows (row_first, cells) are not told
  // Numbers of the triangles, in the order of the whole surface; ascending.
  std::vector<render::IdRun> runs;
};

// As the renderer takes them; `some` must stay.
render::LitSurface lit(const SomeTriangles& some, render::Rgba colour, const render::Placement& placement);

class ExtractCells {
 public:
  // The field is a whole volume, `bricks` its ranges; both must stay. Throws Error kInvalid where they do not
  // fit, kUnsupported as TriangleOrder.
  ExtractCells(const Field& volume, const Bricks& bricks, float isovalue, int threads);

  // The triangles in `boxes` of lattice cells, which do not overlap. Where all are boxes of whole bricks, cut
  // at the volume, one go of the kernel finds them; other boxes take one each, which is slower. Vertices and
  // normals are those of the whole surface, bit for bit; those between two boxes may be there twice. `into`
  // keeps its room. Throws as extract().
  void extract(std::span<const survey::Box> boxes, SomeTriangles& into);

 private:
  bool are_bricks(const survey::Box& box) const;
  void set_bricks(const survey::Box& box, bool there);
  bool is_set(std::int64_t i, std::int64_t j, std::int64_t c) const;
  void extract_bricks(std::span<const survey::Box> boxes, SomeTriangles& into);
  void extract_boxes(std::span<const survey::Box> boxes, SomeTriangles& into);
  void find_runs(SomeTriangles& some) const;

  Field volume_;
  Bricks all_;
  BrickRanges some_;  // of the bricks to extract; nothing is met in the others
  float isovalue_;
  int threads_;
  TriangleOrder order_;
};

}  // namespace footwall::isosurface
