// Scan conversion of a triangle after Kaufman: one voxel for each column of the triangle's bounding plane
// that lies between two edges.
//
// Based on: Kaufman, Efficient algorithms for scan-converting 3D polygons, 1988, as described in seed 004,
// sections 3.6.1 and 3.6.5. The bounding plane is the rectangle around the triangle, seen along the axis w of
// its longest normal component; its voxel in a column is the one nearest to the plane (halves upwards), so
// the result is thin: no column holds two. Edges are Bresenham's lines between the rounded vertices. A row is
// scanned with a flag that is set at the first edge pixel and cleared behind the last; both belong to the
// result. A triangle without area gives the three-dimensional line of its longest edge.
#pragma once
#include <memory>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize {

class Kaufman final : public Voxelizer {
 public:
  Kaufman();
  ~Kaufman() override;
  void rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, RowSink& sink) override;

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace footwall::voxelize
