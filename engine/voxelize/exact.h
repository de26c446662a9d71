// The exact voxelizer: all voxels whose closed unit cube meets the closed triangle (conservative,
// 26-separating), decided in integer arithmetic on the 1/256 lattice, hence alike on every rank, thread and
// processor.
//
// Based on: Schwarz and Seidel, Fast parallel surface and solid voxelization on GPUs, 2010 (plane and
// projected edge tests). Differs in that all tests are solved for the dominant axis at once, so that a
// column's voxels are one span, and in that nothing is rounded. Triangles may be slivers, segments or points,
// and lie anywhere on the lattice.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize {

// Buffers that grow with the largest box met: 24 bytes for each column along its two column axes. One per
// thread.
class ExactScratch {
 public:
  ExactScratch();
  ~ExactScratch();
  ExactScratch(ExactScratch&&) noexcept;
  ExactScratch& operator=(ExactScratch&&) noexcept;

  struct Buffers;
  Buffers& buffers() { return *buffers_; }

 private:
  std::unique_ptr<Buffers> buffers_;
};

// Emits the triangle's voxels inside clip. w is the axis along which the normal is longest (the lowest number
// among equals; for a triangle without area the axis of its greatest extent), u is the sample axis unless
// that is w, then the crossline axis. Rows without any column are left out. Costs O(columns inside clip);
// clip is cut first. Throws what the sink throws, and std::bad_alloc.
void exact_rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch,
                RowSink& sink);

// The number of voxels that exact_rows emits.
std::int64_t count(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch);

// The voxels themselves, in canonical order: v, then u, then w ascending.
void for_each_voxel(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch,
                    const std::function<void(const survey::Index&)>& visit);
std::vector<survey::Index> list(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                                ExactScratch& scratch);

// The smallest box that holds all voxels of the triangle, with or without clipping: its bounding box in
// voxels.
survey::Box bounding_voxels(const survey::LatticeTriangle& triangle);

}  // namespace footwall::voxelize
