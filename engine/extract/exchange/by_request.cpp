#include "engine/extract/exchange/by_request.h"

#include <omp.h>

#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kRequests = 2;
constexpr int kAnswers = 3;

template <typename T>
using PerRank = std::vector<std::vector<T>>;

// What this rank asks for and what it is asked for, by the other rank.
struct Plan {
  OwnFaces faces;
  ListPerRank missing;
  PerRank<Coordinates> requests;
};

Plan plan_of(const Setup& setup, std::int64_t side) {
  Plan plan{own_faces(setup), {}, {}};
  plan.missing = needed_from(setup, plan.faces.crossing);
  leave_out_cached(setup, plan.missing);
  if (side > 1) {
    widen_to_blocks(setup, side, plan.missing);
    for (std::size_t r = 0; r < plan.missing.size(); ++r) {
      plan.missing[r] = setup.cache.lacking(static_cast<int>(r), plan.missing[r]);
    }
  }
  for (const BrickList& list : plan.missing) {
    plan.requests.emplace_back(static_cast<std::size_t>(voxels_in(list)));
    coordinates_of(list, plan.requests.back());
  }
  return plan;
}

}  // namespace

Outcome exchange_by_request(const Setup& setup, std::int64_t side) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  const double start = omp_get_wtime();
  const Plan plan = world.collectively([&] { return plan_of(setup, side); });
  const double voxelized = omp_get_wtime();

  if (ranks > 1) {
    std::vector<std::uint64_t> asking(ranks);
    for (std::size_t r = 0; r < ranks; ++r) asking[r] = plan.requests[r].size();
    const std::vector<std::uint64_t> asked = comm::exchange_sizes(world, asking);
    PerRank<Coordinates> others(ranks);
    PerRank<float> answers(ranks);
    PerRank<float> values(ranks);
    world.collectively([&] {
      for (std::size_t r = 0; r < ranks; ++r) {
        others[r].resize(asked[r]);
        answers[r].resize(asked[r]);
        values[r].resize(asking[r]);
      }
    });
    comm::Transfer requests(world, kRequests);
    comm::Transfer replies(world, kAnswers);
    for (std::size_t r = 0; r < ranks; ++r) {
      requests.receive(static_cast<int>(r), std::as_writable_bytes(std::span(others[r])));
      replies.receive(static_cast<int>(r), std::as_writable_bytes(std::span(values[r])));
    }
    for (std::size_t n = 1; n < ranks; ++n) {
      const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
      requests.send(static_cast<int>(r), std::as_bytes(std::span(plan.requests[r])));
    }
    for (int from = requests.next_received(); from >= 0; from = requests.next_received()) {
      const auto r = static_cast<std::size_t>(from);
      const BrickList list = bricks_of(others[r]);
      gather(setup.blocks, list, answers[r]);
      replies.send(from, std::as_bytes(std::span(answers[r])));
      setup.sent.enter(from, list);
    }
    for (int from = replies.next_received(); from >= 0; from = replies.next_received()) {
      const auto r = static_cast<std::size_t>(from);
      setup.cache.put(from, plan.missing[r], values[r]);
    }
    requests.wait();
    replies.wait();
  }
  const double exchanged = omp_get_wtime();

  world.collectively([&] {
    compute_faces(setup, plan.faces.local, outcome);
    compute_faces(setup, plan.faces.crossing, outcome);
  });
  outcome.seconds.voxelize = voxelized - start;
  outcome.seconds.exchange = exchanged - voxelized;
  outcome.seconds.compute = omp_get_wtime() - exchanged;
  return outcome;
}

}  // namespace footwall::extract
