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

struct ExtractOptions {
  bool normals = true;
  bool keys = false;
  int threads = 1;                   // OpenMP
  std::optional<survey::Box> cells;  // as the volume counts; none: all of the field
  const Bricks* bricks = nullptr;    // skips what the isovalue cannot cross; samples there are not read
};

// Throws Error kInvalid for a field whose sizes do not fit or an isovalue that is not finite, kMemory,
// kUnsupported for 2^32 vertices or more. `into` keeps its room.
void extract(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);

}  // namespace footwall::isosurface
