// The edges of a projected triangle as bounds: seen along one axis, a cube meets the triangle where its
// square does, and each edge then bounds the square's y for a given x. Solved exactly and tabulated once per
// triangle.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/voxelize/detail/int128.h"
#include "storage/survey/points.h"

namespace footwall::voxelize::detail {

// One vertex as an array, so that axes can be chosen at run time.
using Corner = std::array<std::int64_t, 3>;
using Corners = std::array<Corner, 3>;
Corners corners_of(const survey::LatticeTriangle& triangle);

// y <= floor((a x + c) / d) for an upper bound, y >= the same for a lower one; x, y voxel indices, d > 0.
struct Line {
  bool upper = false;
  std::int64_t a = 0;
  std::int64_t c = 0;
  std::int64_t d = 1;
};

struct Lines {
  std::array<Line, 3> line;
  int size = 0;
};

// All bounds that the edges put on y for each x in the projection on (x_axis, y_axis). Edges parallel to y
// give none: they are sides of the bounding box. A projection without area is a segment, bounded from both
// sides.
Lines edge_bounds(const Corners& corners, int x_axis, int y_axis);

// A line in 64-bit fixed point that gives floor((a x + c) / d) exactly for every x in a range:
//   floor = y_ref + ((base + slope * (x - x_mid)) >> shift), in wrapping arithmetic, with shift >= 32.
// Bounds lie within +-2^30, so that differences of two fit 32 bits.
struct FixedLine {
  std::int64_t x_mid = 0;
  std::int32_t y_ref = 0;
  int shift = 32;
  std::int64_t slope = 0;
  std::int64_t base = 0;
};

// False where 64 bits do not suffice for x_first .. x_first + count - 1.
bool to_fixed(const Line& line, std::int64_t x_first, std::int64_t count, FixedLine& fixed);

// lo[n] = max(lo[n], bound) or hi[n] = min(hi[n], bound) at x_first + n, one division and then additions.
void tighten(const Line& line, std::int64_t x_first, std::span<std::int32_t> lo, std::span<std::int32_t> hi);

}  // namespace footwall::voxelize::detail
