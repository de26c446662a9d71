// The owners send, without being asked, all voxels in the bounding boxes of other ranks' faces that they have
// not sent before; meanwhile every rank voxelizes its own faces.
// Based on: seed 004, section 3.4.3 (strategy 3, bounding volume); differs in that a rank's halo of one trace
// counts as its own, and in that local faces are computed, too, while voxels are under way.
// Steps: 1 voxelize: list and pack the voxels of the boxes; 2 exchange: sizes, then coordinates and values,
// 16 bytes a voxel, in messages that do not block; 3 voxelize: the own faces, meanwhile; 4 exchange: wait for
// the rest; 5 compute: keep what came, and the other faces.
#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/phases.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kTag = 4;

// The messages of a pair: the coordinates of all its voxels, then their values.
struct Parcel {
  Message<Coordinates> coordinates;
  Message<float> values;
};
enum Way : std::size_t { kOutgoing, kIncoming };
Parcel parcel(const Setup& setup, Way way, std::size_t rank, std::uint64_t voxels) {
  return {setup.kept.messages.of<Coordinates>(2 * way, rank, voxels),
          setup.kept.messages.of<float>(2 * way + 1, rank, voxels)};
}

}  // namespace

Outcome exchange_bounding(const Setup& setup) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  Phases phases(setup);
  std::vector<std::uint64_t> sending(ranks, 0);
  std::vector<Parcel> outgoing(ranks);
  std::vector<Parcel> incoming(ranks);
  world.collectively([&] {
    ListPerRank wanted = around_faces_of(setup);
    leave_out_sent(setup, wanted);
    for (std::size_t r = 0; r < ranks; ++r) {
      sending[r] = static_cast<std::uint64_t>(voxels_in(wanted[r]));
      outgoing[r] = parcel(setup, kOutgoing, r, sending[r]);
      coordinates_of(wanted[r], outgoing[r].coordinates.items);
      gather(setup.blocks, wanted[r], outgoing[r].values.items);
      setup.sent.enter(static_cast<int>(r), wanted[r]);
    }
  });

  phases.enter(&Seconds::exchange);
  phases.meet();
  const std::vector<std::uint64_t> coming = ranks > 1 ? comm::exchange_sizes(world, sending) : sending;
  phases.enter(&Seconds::compute);
  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) incoming[r] = parcel(setup, kIncoming, r, coming[r]);
  });
  phases.enter(&Seconds::exchange);
  comm::Transfer transfer(world, kTag);
  for (std::size_t r = 0; r < ranks; ++r) {
    transfer.receive(static_cast<int>(r), incoming[r].coordinates.bytes());
    transfer.receive(static_cast<int>(r), incoming[r].values.bytes());
  }
  for (std::size_t n = 1; n < ranks; ++n) {
    const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
    transfer.send(static_cast<int>(r), outgoing[r].coordinates.bytes());
    transfer.send(static_cast<int>(r), outgoing[r].values.bytes());
  }

  phases.enter(&Seconds::voxelize);
  OwnFaces faces;
  world.collectively([&] {
    faces = own_faces(setup);
    ListPerRank needed = needed_from(setup, faces.crossing);
    leave_out_cached(setup, needed);  // counts the hits; all that is left is on its way
    phases.enter(&Seconds::compute);
    compute_faces(setup, faces.local, outcome, [&] { transfer.progress(); });
  });

  phases.enter(&Seconds::exchange);
  phases.meet();
  transfer.wait();
  phases.meet();

  phases.enter(&Seconds::compute);
  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      const Parcel& parcel = incoming[r];
      if (coming[r] > 0 && static_cast<int>(r) != world.rank()) {
        setup.cache.put(static_cast<int>(r), bricks_of(parcel.coordinates.items), parcel.values.items);
      }
    }
    compute_faces(setup, faces.crossing, outcome);
  });
  outcome.seconds = phases.end();
  return outcome;
}

}  // namespace footwall::extract
