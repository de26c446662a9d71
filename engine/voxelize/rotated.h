// The voxelizer of seed 004: rotate the triangle into the plane z = 0 with its longest edge on the x axis,
// rasterize the two other edges, and turn every pixel below them back into a voxel.
//
// Based on: Larsen, A framework for polygonal structures on clusters (seed 004), sections 3.6.2 and 3.6.3,
// appendices E.1 to E.3, with these corrections: the numerator of (3.46) is v_y^2 and its root is taken of
// absolute values; the matrix (E.18) is that of the unit quaternion (sin(t/2) axis, cos(t/2)); the rotations
// combine as q3 q2 q1; line 14 of E.3.1 reads v1' = v1. Half angles come from products and square roots, so
// that every processor finds the same voxels.
//
// Pixels that rounding carries out of the triangle's bounding box are dropped. As printed, the loops stop
// before the pixels of the two rasterized edges; these are not emitted, and a triangle without area, or less
// than a pixel high, has no voxels at all. Neighbouring pixels may round to the same voxel and leave another
// out: `footwall bench voxelize` counts both.
#pragma once
#include <memory>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize {

enum class RotatedLoop {
  kPlain,  // E.3.2: looks at each pixel whether it lies on an edge
  kLc      // E.3.3: no branch inside, up to the lowest edge pixel L_c[x] of each x
};

class Rotated final : public Voxelizer {
 public:
  // `threads` >= 1 share out the x values of one triangle where it has many pixels (section 3.6.3); the
  // result does not depend on them.
  explicit Rotated(RotatedLoop loop = RotatedLoop::kLc, int threads = 1);
  ~Rotated() override;

  void rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, RowSink& sink) override;
  // x ascending along the longest edge from its end nearest the origin, y away from it; a voxel met again is
  // left out.
  void raster(const survey::LatticeTriangle& triangle, const survey::Box& clip,
              std::vector<Voxel>& out) override;
  // One voxel for each pixel.
  void visits(const survey::LatticeTriangle& triangle, const survey::Box& clip,
              std::vector<Voxel>& out) override;

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
  RotatedLoop loop_;
  int threads_;
};

}  // namespace footwall::voxelize
