// Ranks that would rather share triangles than pictures: neighbours send each other their geometry as long as
// that is little against a picture, and then each draws its share of the rows.
// Based on: seed 000, section 5 (step by step over the dimensions of a hypercube; a mutual decision by the
// ratio of the geometry's bytes to the current z-buffer's; a rank that refused once refuses from then on, so
// that groups of several sizes can arise); differs in that the step for ranks beyond a power of two comes
// first and goes one way.
#pragma once
#include <vector>

#include "engine/render/composite/geometry_bytes.h"
#include "engine/render/composite/halving.h"

namespace footwall::render {

struct GroupOptions {
  // Merged while (own + neighbour's geometry bytes) / (bytes of this rank's rows of the visibility buffer) is
  // no more; below 0: never.
  double threshold = 0.1;
  // The most bytes of geometry that a rank will hold.
  std::int64_t memory = std::int64_t{1} << 30;
};

struct Group {
  std::vector<LitSurface> surfaces;  // what this rank draws: its own and its group's
  std::vector<OwnedSurface> received;
  int steps = 0;  // of Halving that need no picture to be merged
};

// surfaces: this rank's; their arrays must outlive the group. bytes_per_row of the visibility buffer.
// Collective. Every decision costs two messages of 8 bytes each way.
Group form_groups(comm::Communicator& world, const Halving& halving, std::span<const LitSurface> surfaces,
                  int rows, std::int64_t bytes_per_row, const GroupOptions& options);

}  // namespace footwall::render
