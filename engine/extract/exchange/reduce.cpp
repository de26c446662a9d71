// Owners fold their own voxels into exact partial sums; these, not voxels, go to the responsible ranks.
// Steps: 1 voxelize: every rank walks the part of every face that lies in its own columns; 2 exchange: one
// round of records; 3 compute: the responsible rank merges and finishes.
#include <omp.h>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/fold_rows.h"
#include "engine/extract/parallel_faces.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

// A thread's tools and what it has to send.
struct Worker {
  std::unique_ptr<voxelize::Voxelizer> voxelizer;
  std::vector<std::unique_ptr<RowFolder>> folders;  // one for each block
  std::vector<comm::Bytes> outgoing;
  std::int64_t walked = 0;
};

std::vector<comm::Bytes> fold_own(const Setup& setup, std::int64_t& walked) {
  const auto ranks = static_cast<std::size_t>(setup.world.size());
  std::vector<comm::Bytes> outgoing(ranks);
  const std::span<const Block> blocks = setup.blocks.all();
  if (blocks.empty()) return outgoing;

  std::vector<Worker> workers(static_cast<std::size_t>(setup.threads));
  for (Worker& worker : workers) {
    worker.voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
    for (const Block& block : blocks) {
      worker.folders.push_back(std::make_unique<RowFolder>(block, setup.with_discontinuity, setup.scale));
    }
    worker.outgoing.resize(ranks);
  }
  parallel_faces(setup.input.faces.size(), setup.threads, setup.job, "voxelize",
                 [&](std::size_t thread, std::size_t n) {
                   const survey::LatticeTriangle& triangle = setup.face(n).triangle;
                   const survey::Box around = voxelize::bounding_voxels(triangle);
                   Worker& worker = workers[thread];
                   Partial partial;
                   for (std::size_t b = 0; b < blocks.size(); ++b) {
                     if (survey::intersection(around, blocks[b].own()).empty()) continue;
                     worker.voxelizer->rows(triangle, blocks[b].own(), *worker.folders[b]);
                     partial.merge(worker.folders[b]->take());
                   }
                   if (partial.voxels() == 0) return;
                   worker.walked += partial.voxels();
                   encode(static_cast<std::int64_t>(n), partial,
                          worker.outgoing[static_cast<std::size_t>(setup.responsible[n])]);
                 });
  for (Worker& worker : workers) {
    walked += worker.walked;
    for (std::size_t r = 0; r < ranks; ++r) {
      outgoing[r].insert(outgoing[r].end(), worker.outgoing[r].begin(), worker.outgoing[r].end());
      worker.outgoing[r] = {};
    }
  }
  return outgoing;
}

std::vector<Finished> merge_all(const Setup& setup, const std::vector<comm::Bytes>& incoming) {
  const std::size_t faces = setup.input.faces.size();
  std::vector<std::int64_t> slot(faces, -1);
  std::vector<Finished> finished;
  for (std::size_t n = 0; n < faces; ++n) {
    if (!setup.mine(n)) continue;
    slot[n] = static_cast<std::int64_t>(finished.size());
    finished.push_back({static_cast<std::int64_t>(n), {}});
  }
  std::vector<Partial> partials(finished.size());
  for (const comm::Bytes& bytes : incoming) {
    std::span<const std::byte> rest(bytes);
    while (!rest.empty()) {
      Partial part;
      const std::int64_t face = decode(rest, part);
      require(
          face >= 0 && static_cast<std::size_t>(face) < faces && slot[static_cast<std::size_t>(face)] >= 0,
          "partial sums of a face of this rank");
      partials[static_cast<std::size_t>(slot[static_cast<std::size_t>(face)])].merge(part);
    }
  }
  parallel_faces(finished.size(), setup.threads, setup.job, "compute", [&](std::size_t, std::size_t n) {
    const auto face = static_cast<std::size_t>(finished[n].face);
    finished[n].statistics = finish(partials[n], inside(setup.face(face).triangle, setup.input.dims));
  });
  return finished;
}

}  // namespace

Outcome exchange_reduce(const Setup& setup) {
  Outcome outcome;
  const double start = omp_get_wtime();
  std::vector<comm::Bytes> outgoing =
      setup.world.collectively([&] { return fold_own(setup, outcome.walked); });
  const double voxelized = omp_get_wtime();
  const std::vector<comm::Bytes> incoming = setup.world.exchange(std::move(outgoing));
  const double exchanged = omp_get_wtime();
  outcome.finished = setup.world.collectively([&] { return merge_all(setup, incoming); });
  outcome.seconds.voxelize = voxelized - start;
  outcome.seconds.exchange = exchanged - voxelized;
  outcome.seconds.compute = omp_get_wtime() - exchanged;
  return outcome;
}

}  // namespace footwall::extract
