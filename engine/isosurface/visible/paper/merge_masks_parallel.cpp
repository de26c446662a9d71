#include <array>
#include <vector>

#include "engine/isosurface/visible/paper/merge_masks.h"
#include "engine/render/composite/halving.h"

namespace footwall::isosurface {
namespace {

using render::Halving;
using render::Rows;

// What is sent to a partner, and the room for what it sends; both sides know the sizes.
struct Swap {
  int partner = 0;
  Rows give;
  Rows take;
};

void swap(comm::Communicator& world, const std::vector<Swap>& swaps, render::CoverageMask& mine) {
  const auto words_in = [&](const Rows& rows) {
    return static_cast<std::size_t>(rows.count()) * static_cast<std::size_t>(mine.tile_columns());
  };
  std::vector<comm::KnownOutgoing> outgoing;
  std::vector<comm::KnownIncoming> incoming;
  std::vector<std::vector<std::uint64_t>> received;
  for (const Swap& each : swaps) {
    if (each.give.count() > 0) {
      const auto bytes = std::as_bytes(mine.tiles(each.give.begin, each.give.end));
      outgoing.push_back({each.partner, bytes, bytes.size()});
    }
    received.emplace_back(words_in(each.take));
    if (each.take.count() > 0)
      incoming.push_back({each.partner, std::as_writable_bytes(std::span(received.back()))});
  }
  world.exchange_known(outgoing, incoming);
  for (std::size_t n = 0; n < swaps.size(); ++n) mine.merge(swaps[n].take.begin, received[n]);
}

}  // namespace

void merge_masks(comm::Communicator& world, render::CoverageMask& mine) {
  const Halving halving(world.size());
  const Rows whole{0, mine.tile_rows()};
  const Rows nothing{0, 0};
  // 1. Halves change hands; in step 0 ranks beyond the largest power of two give all.
  for (int step = 0; step < halving.steps(); ++step) {
    const int partner = halving.partner(world.rank(), step);
    if (partner < 0) continue;
    if (step == 0) {
      const bool gives = halving.gives(world.rank());
      swap(world, {{partner, gives ? whole : nothing, gives ? nothing : whole}}, mine);
    } else {
      swap(world,
           {{partner, halving.rows(partner, step + 1, whole), halving.rows(world.rank(), step + 1, whole)}},
           mine);
    }
  }
  // 2. Each part to rank 0.
  if (halving.gives(world.rank())) return;
  std::vector<Swap> parts;
  if (world.rank() == 0) {
    for (int rank = 1; rank < halving.core(); ++rank)
      parts.push_back({rank, nothing, halving.rows(rank, halving.steps(), whole)});
  } else {
    parts.push_back({0, halving.rows(world.rank(), halving.steps(), whole), nothing});
  }
  swap(world, parts, mine);
}

}  // namespace footwall::isosurface
