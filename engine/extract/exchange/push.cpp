// The owners send the values that nobody had to ask for. Every rank knows all faces and who is responsible
// for them, so an owner finds the voxels of each receiver's faces in its own columns, and the receiver finds
// the same: only values travel, 4 bytes each, in one round of messages whose sizes both sides know; pairs
// that share nothing exchange nothing. Needs: a voxelizer that decides alike on every rank. The size of every
// message is checked against what was expected. Steps: 1 voxelize: what others need of this rank, what it
// needs of others, both without what was sent before; 2 exchange: post receives, gather and send; 3 compute:
// the faces that need nothing, meanwhile; 4 exchange: keep what came; 5 compute: the other faces.
#include <omp.h>

#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kTag = 5;

}  // namespace

Outcome exchange_push(const Setup& setup) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  const double start = omp_get_wtime();
  double voxelized = start;
  OwnFaces faces;
  ListPerRank wanted;
  ListPerRank needed;
  std::vector<std::vector<float>> outgoing(ranks);
  std::vector<std::vector<float>> incoming(ranks);
  world.collectively([&] {
    wanted = needed_by(setup);
    leave_out_sent(setup, wanted);
    faces = own_faces(setup);
    needed = needed_from(setup, faces.crossing);
    leave_out_cached(setup, needed);
    voxelized = omp_get_wtime();
    for (std::size_t r = 0; r < ranks; ++r) {
      incoming[r].resize(static_cast<std::size_t>(voxels_in(needed[r])));
      outgoing[r].resize(static_cast<std::size_t>(voxels_in(wanted[r])));
      gather(setup.blocks, wanted[r], outgoing[r]);
      setup.sent.enter(static_cast<int>(r), wanted[r]);
    }
  });

  comm::Transfer transfer(world, kTag);
  for (std::size_t r = 0; r < ranks; ++r) {
    transfer.receive(static_cast<int>(r), std::as_writable_bytes(std::span(incoming[r])));
  }
  for (std::size_t n = 1; n < ranks; ++n) {
    const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
    transfer.send(static_cast<int>(r), std::as_bytes(std::span(outgoing[r])));
  }
  const double posted = omp_get_wtime();

  world.collectively([&] { compute_faces(setup, faces.local, outcome, [&] { transfer.progress(); }); });
  const double computed = omp_get_wtime();

  for (int from = transfer.next_received(); from >= 0; from = transfer.next_received()) {
    const auto r = static_cast<std::size_t>(from);
    setup.cache.put(from, needed[r], incoming[r]);
  }
  transfer.wait();
  const double exchanged = omp_get_wtime();

  world.collectively([&] { compute_faces(setup, faces.crossing, outcome); });
  outcome.seconds.voxelize = voxelized - start;
  outcome.seconds.exchange = posted - voxelized + (exchanged - computed);
  outcome.seconds.compute = computed - posted + (omp_get_wtime() - exchanged);
  return outcome;
}

}  // namespace footwall::extract
