// Surfaces as bytes, to be sent to another rank.
#pragma once
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/render/lit_surface.h"

namespace footwall::render {

struct OwnedSurface {
  Rgba colour = 0;
  Placement placement;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<TriangleIndices> triangles;
  std::vector<IdRun> runs;

  LitSurface view() const { return {colour, placement, positions, normals, triangles, runs}; }
};

// How many bytes bytes_of() takes.
std::int64_t size_of(std::span<const LitSurface> surfaces);
comm::Bytes bytes_of(std::span<const LitSurface> surfaces);
// Throws Error kCorrupt for other bytes.
std::vector<OwnedSurface> surfaces_from(std::span<const std::byte> bytes);

}  // namespace footwall::render
