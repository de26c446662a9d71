// Which pixels of a flat triangle are turned into voxels: for every x those below the rasterized edges.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/voxelize/detail/rotation.h"
#include "storage/survey/box.h"

namespace footwall::voxelize::detail {

// The pixels lo..hi of an edge at one x; none where lo > hi.
struct EdgePixels {
  std::int32_t lo = 0;
  std::int32_t hi = -1;
  bool has(std::int64_t y) const { return y >= lo && y <= hi; }
};

// Both rasterized edges by x, 0..x3 (L_1 and L_2 of appendix E.3.2).
struct Edges {
  std::vector<EdgePixels> edge12;  // from (0, 0) to (x2, y2)
  std::vector<EdgePixels> edge23;  // from (x2, y2) to (x3, 0)
};
void rasterize(const FlatTriangle& flat, Edges& edges);

// Pixels first..last-1 at one x, and how many there are at smaller x.
struct PixelColumn {
  std::int32_t first = 0;
  std::int32_t last = 0;
  std::int64_t before = 0;
  std::int64_t size() const { return last - first; }
};

// The pixels y < L_c[x], the lowest edge pixel of each x, whose voxels lie in the box: one run for each x,
// because every coordinate of the voxel is monotone in y. Returns their number.
std::int64_t columns_below(const Edges& edges, const FlatTriangle& flat, const survey::Box& box,
                           std::vector<PixelColumn>& columns);

}  // namespace footwall::voxelize::detail
