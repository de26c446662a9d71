// What every voxelizer emits: rows of column spans, consumed while they are in cache; coordinates are never
// listed.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::voxelize {

// One row of columns of one triangle. The axes (0 inline, 1 crossline, 2 sample) are a permutation: v is
// fixed, u runs u0, u0 + 1, ..., u0 + lo.size() - 1, and column n holds the voxels lo[n]..hi[n], both
// included, along w. A column with hi[n] < lo[n] is empty; hi[n] - lo[n] + 1 never overflows. The spans are
// valid during the call only.
struct Row {
  int u_axis = 2;
  int v_axis = 1;
  int w_axis = 0;
  std::int64_t u0 = 0;
  std::int64_t v = 0;
  std::span<const std::int32_t> lo;
  std::span<const std::int32_t> hi;
};

// Takes the rows of one triangle after the other. May throw; the voxelizer stays usable.
class RowSink {
 public:
  virtual ~RowSink() = default;
  virtual void row(const Row& row) = 0;
};

// A voxel's index (inline, crossline, sample) in 12 bytes, for lists of many.
using Voxel = std::array<std::int32_t, 3>;

// A voxelization method with the buffers it works in: one object per thread, used again for every triangle.
class Voxelizer {
 public:
  virtual ~Voxelizer() = default;
  // Every voxel of the triangle that lies in clip, each exactly once; none of them lies outside
  // bounding_voxels() (exact.h). They come in canonical order: ascending v, then
  // u, then w, where the axes depend on the triangle alone. A row may hold empty columns, and several rows
  // may have the same v (the later one begins at the column where the other ends, or behind it). The union
  // over disjoint boxes is the result for their union, and the order in a box is that of the whole with the
  // others left out. Throws what the sink throws, and std::bad_alloc.
  virtual void rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, RowSink& sink) = 0;

  // The same voxels, each once, in the order in which the method itself walks over the face, which is what a
  // one-dimensional transform of the face's values needs (seed 004, section 5.2.1): for `rotated` the raster
  // along the longest edge, for a method that does not override this the canonical order. `out` is replaced.
  virtual void raster(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                      std::vector<Voxel>& out);

  // Every voxel as often as the method comes upon it, in its own order; the same as raster() for a method
  // that meets none twice. For measuring; `out` is replaced.
  virtual void visits(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                      std::vector<Voxel>& out);
};

// The number of voxels in a row's columns.
inline std::int64_t voxels_in(const Row& row) {
  std::int64_t sum = 0;
  const std::int32_t* lo = row.lo.data();
  const std::int32_t* hi = row.hi.data();
  const std::size_t columns = row.lo.size();
  // Partial sums in 32 bits, so that the compiler can add many columns at once; a column has at most 2^25
  // voxels.
  constexpr std::size_t kBlock = 64;
  for (std::size_t first = 0; first < columns; first += kBlock) {
    const std::size_t last = first + kBlock < columns ? first + kBlock : columns;
    std::uint32_t part = 0;
    for (std::size_t n = first; n < last; ++n) {
      const std::int32_t length = hi[n] - lo[n] + 1;
      part += static_cast<std::uint32_t>(length > 0 ? length : 0);
    }
    sum += part;
  }
  return sum;
}

}  // namespace footwall::voxelize
