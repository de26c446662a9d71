// The owners send the values that nobody had to ask for. Every rank knows all faces and who is responsible
// for them, so an owner finds the voxels of each receiver's faces in its own columns, and the receiver finds
// the same: only values travel, 4 bytes each, in one round of messages whose sizes both sides know; pairs
// that share nothing exchange nothing. The voxelizer must decide alike on every rank; the size of every
// message is checked. Steps: 1 voxelize: what others need of this rank, gathered, and what it needs of
// others, both without what was sent before; 2 exchange: post receives and sends; 3 compute: the faces that
// need nothing, meanwhile; 4 exchange: wait for the rest; 5 compute: keep what came, and the other faces.
#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/phases.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kTag = 5;

// Kinds of messages.
enum Kind : std::size_t { kOutgoing, kIncoming };

}  // namespace

Outcome exchange_push(const Setup& setup) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  Phases phases(setup);
  OwnFaces faces;
  ListPerRank needed;
  MessagePerRank<float> outgoing(ranks);
  MessagePerRank<float> incoming(ranks);
  world.collectively([&] {
    ListPerRank wanted = needed_by(setup);
    leave_out_sent(setup, wanted);
    faces = own_faces(setup);
    needed = needed_from(setup, faces.crossing);
    leave_out_cached(setup, needed);
    for (std::size_t r = 0; r < ranks; ++r) {
      incoming[r] =
          setup.kept.messages.of<float>(kIncoming, r, static_cast<std::size_t>(voxels_in(needed[r])));
      outgoing[r] =
          setup.kept.messages.of<float>(kOutgoing, r, static_cast<std::size_t>(voxels_in(wanted[r])));
      gather(setup.blocks, wanted[r], outgoing[r].items);
      setup.sent.enter(static_cast<int>(r), wanted[r]);
    }
  });

  phases.enter(&Seconds::exchange);
  comm::Transfer transfer(world, kTag);
  for (std::size_t r = 0; r < ranks; ++r) {
    transfer.receive(static_cast<int>(r), incoming[r].bytes());
  }
  for (std::size_t n = 1; n < ranks; ++n) {
    const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
    transfer.send(static_cast<int>(r), outgoing[r].bytes());
  }

  phases.enter(&Seconds::compute);
  world.collectively([&] { compute_faces(setup, faces.local, outcome, [&] { transfer.progress(); }); });

  phases.enter(&Seconds::exchange);
  phases.meet();
  transfer.wait();
  phases.meet();

  phases.enter(&Seconds::compute);
  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      if (!needed[r].empty()) setup.cache.put(static_cast<int>(r), needed[r], incoming[r].items);
    }
    compute_faces(setup, faces.crossing, outcome);
  });
  outcome.seconds = phases.end();
  return outcome;
}

}  // namespace footwall::extract
