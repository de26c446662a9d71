// The owners send, without being asked, all voxels in the bounding boxes of other ranks' faces that they have
// not sent before; meanwhile every rank voxelizes its own faces.
// Based on: seed 004, section 3.4.3 (strategy 3, bounding volume); differs in that a rank's halo of one trace
// counts as its own, and in that local faces are computed, too, while voxels are under way.
// Steps: 1 voxelize: the voxels of the boxes; 2 exchange: sizes, then coordinates and values, 16 bytes a
// voxel, in messages that do not block; 3 voxelize: the own faces, meanwhile; 4 exchange: wait for the rest
// and keep what came; 5 compute.
#include <omp.h>

#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kTag = 4;

// A message: the coordinates of all its voxels, then their values.
struct Parcel {
  std::vector<Coordinates> coordinates;
  std::vector<float> values;
};

}  // namespace

Outcome exchange_bounding(const Setup& setup) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  const double start = omp_get_wtime();
  ListPerRank wanted = world.collectively([&] {
    ListPerRank lists = around_faces_of(setup);
    leave_out_sent(setup, lists);
    return lists;
  });
  const double listed = omp_get_wtime();

  std::vector<std::uint64_t> sending(ranks);
  for (std::size_t r = 0; r < ranks; ++r) sending[r] = static_cast<std::uint64_t>(voxels_in(wanted[r]));
  std::vector<Parcel> outgoing(ranks);
  std::vector<Parcel> incoming(ranks);
  const std::vector<std::uint64_t> coming = ranks > 1 ? comm::exchange_sizes(world, sending) : sending;
  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      incoming[r].coordinates.resize(coming[r]);
      incoming[r].values.resize(coming[r]);
      outgoing[r].coordinates.resize(sending[r]);
      outgoing[r].values.resize(sending[r]);
      coordinates_of(wanted[r], outgoing[r].coordinates);
      gather(setup.blocks, wanted[r], outgoing[r].values);
      setup.sent.enter(static_cast<int>(r), wanted[r]);
    }
  });
  comm::Transfer transfer(world, kTag);
  for (std::size_t r = 0; r < ranks; ++r) {
    transfer.receive(static_cast<int>(r), std::as_writable_bytes(std::span(incoming[r].coordinates)));
    transfer.receive(static_cast<int>(r), std::as_writable_bytes(std::span(incoming[r].values)));
  }
  for (std::size_t n = 1; n < ranks; ++n) {
    const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
    transfer.send(static_cast<int>(r), std::as_bytes(std::span(outgoing[r].coordinates)));
    transfer.send(static_cast<int>(r), std::as_bytes(std::span(outgoing[r].values)));
  }
  const double posted = omp_get_wtime();

  OwnFaces faces;
  double voxelized = posted;
  world.collectively([&] {
    faces = own_faces(setup);
    ListPerRank needed = needed_from(setup, faces.crossing);
    leave_out_cached(setup, needed);  // counts the hits; all that is left is on its way
    voxelized = omp_get_wtime();
    compute_faces(setup, faces.local, outcome, [&] { transfer.progress(); });
  });
  const double computed = omp_get_wtime();

  for (int from = transfer.next_received(); from >= 0; from = transfer.next_received()) {
    const Parcel& parcel = incoming[static_cast<std::size_t>(from)];
    setup.cache.put(from, bricks_of(parcel.coordinates), parcel.values);
  }
  transfer.wait();
  const double exchanged = omp_get_wtime();

  world.collectively([&] { compute_faces(setup, faces.crossing, outcome); });
  outcome.seconds.voxelize = listed - start + (voxelized - posted);
  outcome.seconds.exchange = posted - listed + (exchanged - computed);
  outcome.seconds.compute = computed - voxelized + (omp_get_wtime() - exchanged);
  return outcome;
}

}  // namespace footwall::extract
