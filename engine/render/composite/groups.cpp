#include "engine/render/composite/groups.h"

#include "engine/render/composite/send.h"

namespace footwall::render {
namespace {

std::int64_t swap_number(comm::Communicator& world, int partner, std::int64_t mine) {
  std::int64_t other = 0;
  const comm::KnownOutgoing to{partner, std::as_bytes(std::span(&mine, 1)), sizeof mine};
  comm::KnownIncoming from{partner, std::as_writable_bytes(std::span(&other, 1))};
  world.exchange_known(std::span(&to, 1), std::span(&from, 1));
  return other;
}

}  // namespace

Group form_groups(comm::Communicator& world, const Halving& halving, std::span<const LitSurface> surfaces,
                  int rows, std::int64_t bytes_per_row, const GroupOptions& options) {
  Group group;
  group.surfaces.assign(surfaces.begin(), surfaces.end());
  std::int64_t bytes = size_of(surfaces);
  bool refused = false;
  for (int step = 0; step < halving.steps(); ++step) {
    const int partner = halving.partner(world.rank(), step);
    if (partner < 0) {
      // Nobody to merge with, and so nothing that is missing.
      if (!refused && !halving.gives(world.rank())) group.steps = step + 1;
      continue;
    }
    // 1. How much is there?
    const std::int64_t others = swap_number(world, partner, bytes);
    // 2. Is it worth while, and is there room?
    const Rows held = halving.rows(world.rank(), group.steps, {0, rows});
    const auto picture = static_cast<double>(held.count()) * static_cast<double>(bytes_per_row);
    const bool willing = !refused && static_cast<double>(bytes + others) <= options.threshold * picture &&
                         bytes + others <= options.memory;
    // 3. For both?
    const bool both = swap_number(world, partner, willing ? 1 : 0) == 1 && willing;
    // 4. Then each gets the other's; the ranks beyond the core are done with that.
    refused = refused || !both;
    if (!both) continue;
    group.steps = step + 1;
    comm::Bytes received;
    if (halving.gives(world.rank())) {
      give_to(world, partner, bytes_of(group.surfaces));
      group.surfaces.clear();
      return group;
    }
    if (step == 0) {
      received = take_from(world, partner);
    } else {
      received = swap_with(world, partner, bytes_of(group.surfaces));
    }
    for (OwnedSurface& surface : surfaces_from(received)) {
      // Arrays stay where they are when the list grows.
      group.received.push_back(std::move(surface));
      group.surfaces.push_back(group.received.back().view());
    }
    bytes += others;
  }
  return group;
}

}  // namespace footwall::render
