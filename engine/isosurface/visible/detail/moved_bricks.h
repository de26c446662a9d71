// Bricks whose samples go to a rank that has less to do.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/visible/detail/pending_bricks.h"

namespace footwall::isosurface::detail {

struct Move {
  int from = 0;
  int to = 0;
  std::int64_t work = 0;
  friend bool operator==(const Move&, const Move&) = default;
};
// What has to go where so that all ranks have the mean, as little as possible; none where the busiest rank
// has at most `tolerance` more than that already. The same on all ranks.
std::vector<Move> moves_for(std::span<const std::int64_t> work_of_ranks, double tolerance);

// Gives away chosen parts of about so much work: they are no longer pending here. One message per rank.
// parts: the rank's, of the volume.
std::vector<std::vector<std::byte>> give_away(std::span<const Move> moves, int rank, int ranks,
                                              std::span<const VolumePart> parts, PendingBricks& bricks);

struct MovedBrick {
  survey::Index at{0, 0, 0};
  BrickParts chosen = 0;
  Field field;
  std::vector<float> values;
};
// Of a message. Throws Error kCorrupt for other bytes.
std::vector<MovedBrick> taken_from(std::span<const std::byte> message, const survey::Index& volume_size);

}  // namespace footwall::isosurface::detail
