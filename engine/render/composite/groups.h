// Ranks that would rather share triangles than pictures: neighbours send each other their geometry as long as
// that is little against a picture, and then each draws its share of the rows.
// Based on: seed 000, section 5 (step by step over the dimensions of a hypercube; a mutual decision by the
// ratio of the geometry's bytes to the current z-buffer's; a rank that refused once refuses from then on, so
// that groups of several sizes can arise); differs in that the step for ranks beyond a power of two comes
// first and goes one way, in that partners tell each other all that decides, so that one message each way is
// enough, and in that estimated times may decide.
#pragma once
#include <optional>
#include <vector>

#include "engine/render/composite/geometry_bytes.h"
#include "engine/render/composite/group_rates.h"
#include "engine/render/composite/halving.h"

namespace footwall::render {

struct GroupOptions {
  // Merged while (own + neighbour's geometry bytes) / (bytes of the rows of the visibility buffer that each
  // of them holds) is no more; below 0: never.
  double threshold = 0.1;
  // The most bytes of geometry that this rank will hold; ranks may differ.
  std::int64_t memory = std::int64_t{1} << 30;
  // Decide instead of the threshold: merged while the neighbour's geometry takes less time to get and draw
  // than its pixels. The same on every rank.
  std::optional<GroupRates> rates = std::nullopt;
};

struct Group {
  std::vector<LitSurface> surfaces;  // what this rank draws: its own and its group's
  std::vector<OwnedSurface> received;
  int steps = 0;  // of Halving that need no picture to be merged
};

// surfaces: this rank's; their arrays must outlive the group. width, height: of the picture. Collective.
// Every decision costs a message of 40 bytes each way.
Group form_groups(comm::Communicator& world, const Halving& halving, std::span<const LitSurface> surfaces,
                  const Camera& camera, int width, int height, const GroupOptions& options);

}  // namespace footwall::render
