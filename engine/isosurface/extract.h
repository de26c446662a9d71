// Isosurfaces by marching cubes: the surface where the field, trilinear inside every cell, has the isovalue.
//
// A sample is inside where v >= isovalue. A cell with a null sample has no triangles, so that the surface
// ends at a clean border there, as it does at the border of the volume. A vertex lies at t = (isovalue - a) /
// (b - a) of its edge, in float32, held in [2^-10, 1 - 2^-10], so that no triangle has area zero. Normals are
// the negated gradient, made of central differences at both ends of the edge (one-sided where the field ends,
// or next to a null sample) and interpolated; a vertex whose gradient is zero gets the direction of its edge.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "engine/isosurface/field.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

// Which values can occur in a brick of 8 x 8 x 8 cells: entry (a, b, c) covers samples 8a .. 8a + 8 inclusive
// of the whole volume, as level 0 in storage/volume/min_max.h.
struct Bricks {
  survey::Index dims{0, 0, 0};
  std::span<const float> min;  // [a][b][c]; +infinity where all samples are null
  std::span<const float> max;  // -infinity there
  std::span<const std::uint8_t> has_null;
};

// Which parts of bricks are wanted, one word per brick of Bricks: bit 16 a + 4 b + c stands for the 2 x 2 x 2
// cells of the brick that begin at its cell (2 a, 2 b, 2 c).
using BrickParts = std::uint64_t;
inline constexpr BrickParts kWholeBrick = ~BrickParts{0};

// The triangles of one part of a brick in one row (i, j) of cells: those from `first_triangle` up to the next
// run's.
struct PartRun {
  std::uint64_t first_triangle = 0;
  std::int64_t i = 0;  // of the volume's cells
  std::int64_t j = 0;
  std::int64_t part = 0;  // along samples, from the volume's first on: cells 2 part and 2 part + 1
};

struct ExtractOptions {
  bool normals = true;
  bool keys = false;
  int threads = 1;                   // OpenMP
  std::optional<survey::Box> cells;  // as the volume counts; none: all of the field
  const Bricks* bricks = nullptr;    // skips what the isovalue cannot cross; samples there are not read
  // With bricks: makes the triangles of these parts alone, with the vertices, normals and order that they
  // have in the whole surface. None: all parts.
  std::span<const BrickParts> parts;
  // With bricks: is told where each part's triangles stand, in their order; runs without triangles are left
  // out.
  std::vector<PartRun>* part_runs = nullptr;
};

// Throws Error kInvalid for a field whose sizes do not fit or an isovalue that is not finite, kMemory,
// kUnsupported for 2^32 vertices or more. `into` keeps its room.
void extract(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);

}  // namespace footwall::isosurface
