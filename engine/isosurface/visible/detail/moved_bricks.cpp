#include "engine/isosurface/visible/detail/moved_bricks.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

// What stands before a brick's samples.
struct Head {
  survey::Index at{0, 0, 0};
  BrickParts chosen = 0;
};

survey::Box samples_of(const survey::Index& brick, const survey::Index& volume_size) {
  survey::Box samples;
  for (int axis = 0; axis < 3; ++axis) {
    samples.lo[axis] = std::max<std::int64_t>(0, 8 * brick[axis] - 1);
    samples.hi[axis] = std::min(8 * brick[axis] + 10, volume_size[axis]);
  }
  return samples;
}

void append(const void* from, std::size_t bytes, std::vector<std::byte>& to) {
  const auto* const first = static_cast<const std::byte*>(from);
  to.insert(to.end(), first, first + bytes);
}

void append_brick(const PendingBrick& brick, const Field& field, std::vector<std::byte>& to) {
  const Head head{brick.at, brick.chosen};
  append(&head, sizeof head, to);
  const survey::Box samples = samples_of(brick.at, field.volume_size);
  for (std::int64_t i = samples.lo[0]; i < samples.hi[0]; ++i) {
    for (std::int64_t j = samples.lo[1]; j < samples.hi[1]; ++j) {
      const std::int64_t row = (i - field.origin[0]) * field.size[1] + j - field.origin[1];
      const float* const from = field.values.data() + row * field.size[2] + samples.lo[2] - field.origin[2];
      append(from, static_cast<std::size_t>(samples.size(2)) * sizeof(float), to);
    }
  }
}

}  // namespace

std::vector<Move> moves_for(std::span<const std::int64_t> work_of_ranks, double tolerance) {
  const auto ranks = static_cast<std::int64_t>(work_of_ranks.size());
  const std::int64_t all = std::accumulate(work_of_ranks.begin(), work_of_ranks.end(), std::int64_t{0});
  const std::int64_t most = *std::max_element(work_of_ranks.begin(), work_of_ranks.end());
  if (static_cast<double>(most * ranks) <= (1 + tolerance) * static_cast<double>(all)) return {};
  // Means that add up to all of it.
  const auto goal = [&](std::int64_t rank) { return all * (rank + 1) / ranks - all * rank / ranks; };
  std::vector<Move> moves;
  std::int64_t to = 0;
  std::int64_t room = goal(0) - work_of_ranks[0];
  for (std::int64_t from = 0; from < ranks; ++from) {
    std::int64_t left = work_of_ranks[static_cast<std::size_t>(from)] - goal(from);
    while (left > 0) {
      while (room <= 0 && to + 1 < ranks) {
        ++to;
        room = goal(to) - work_of_ranks[static_cast<std::size_t>(to)];
      }
      const std::int64_t work = std::min(left, room);
      if (work <= 0) break;
      moves.push_back({static_cast<int>(from), static_cast<int>(to), work});
      left -= work;
      room -= work;
    }
  }
  return moves;
}

std::vector<std::vector<std::byte>> give_away(std::span<const Move> moves, int rank, int ranks,
                                              std::span<const VolumePart> parts, PendingBricks& bricks) {
  std::vector<std::vector<std::byte>> messages(static_cast<std::size_t>(ranks));
  // Those with the most work first: few messages' bytes for it.
  std::vector<PendingBrick*> order;
  for (PendingBrick& brick : bricks.bricks()) {
    if (brick.chosen != 0) order.push_back(&brick);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const PendingBrick* a, const PendingBrick* b) { return a->work > b->work; });
  for (const Move& move : moves) {
    if (move.from != rank) continue;
    std::int64_t left = move.work;
    for (PendingBrick* const brick : order) {
      if (left <= 0) break;
      if (brick->chosen == 0 || brick->work == 0 || brick->work > left) continue;
      append_brick(*brick, parts[brick->part].field, messages[static_cast<std::size_t>(move.to)]);
      brick->pending &= ~brick->chosen;
      brick->drawn |= brick->chosen;
      brick->chosen = 0;
      left -= brick->work;
    }
  }
  return messages;
}

std::vector<MovedBrick> taken_from(std::span<const std::byte> message, const survey::Index& volume_size) {
  const Error broken(ErrorCode::kCorrupt, "a message with bricks is not whole");
  std::vector<MovedBrick> bricks;
  while (!message.empty()) {
    Head head;
    if (message.size() < sizeof head) throw broken;
    std::memcpy(&head, message.data(), sizeof head);
    message = message.subspan(sizeof head);
    for (int axis = 0; axis < 3; ++axis) {
      if (head.at[axis] < 0 || 8 * head.at[axis] >= volume_size[axis]) throw broken;
    }
    const survey::Box samples = samples_of(head.at, volume_size);
    MovedBrick& brick = bricks.emplace_back();
    brick.at = head.at;
    brick.chosen = head.chosen;
    brick.values.resize(static_cast<std::size_t>(samples.count()));
    const std::size_t bytes = brick.values.size() * sizeof(float);
    if (message.size() < bytes) throw broken;
    std::memcpy(brick.values.data(), message.data(), bytes);
    message = message.subspan(bytes);
    brick.field = {
        brick.values, {samples.size(0), samples.size(1), samples.size(2)}, samples.lo, volume_size};
  }
  return bricks;
}

}  // namespace footwall::isosurface::detail
