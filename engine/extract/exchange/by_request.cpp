#include "engine/extract/exchange/by_request.h"

#include <omp.h>

#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/message_buffer.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kRequests = 2;
constexpr int kAnswers = 3;

// What this rank asks of each other.
struct Plan {
  OwnFaces faces;
  ListPerRank missing;
  BufferPerRank<Coordinates> requests;
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
    coordinates_of(list, plan.requests.back().items());
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

  BufferPerRank<Coordinates> asked(ranks);
  BufferPerRank<float> answers(ranks);
  BufferPerRank<float> values(ranks);
  if (ranks > 1) {
    std::vector<std::uint64_t> asking(ranks);
    for (std::size_t r = 0; r < ranks; ++r) asking[r] = plan.requests[r].size();
    const std::vector<std::uint64_t> being_asked = comm::exchange_sizes(world, asking);
    world.collectively([&] {
      for (std::size_t r = 0; r < ranks; ++r) {
        asked[r] = MessageBuffer<Coordinates>(being_asked[r]);
        answers[r] = MessageBuffer<float>(being_asked[r]);
        values[r] = MessageBuffer<float>(asking[r]);
      }
    });
    comm::Transfer requests(world, kRequests);
    comm::Transfer replies(world, kAnswers);
    for (std::size_t r = 0; r < ranks; ++r) {
      requests.receive(static_cast<int>(r), asked[r].bytes());
      replies.receive(static_cast<int>(r), values[r].bytes());
    }
    for (std::size_t n = 1; n < ranks; ++n) {
      const std::size_t r = (static_cast<std::size_t>(world.rank()) + n) % ranks;  // not all to rank 0 first
      requests.send(static_cast<int>(r), plan.requests[r].bytes());
    }
    while (const std::optional<int> from = requests.next_received()) {
      const auto r = static_cast<std::size_t>(*from);
      gather(setup.blocks, std::as_const(asked[r]).items(), answers[r].items());
      replies.send(*from, answers[r].bytes());
    }
    requests.wait();
    replies.wait();
  }
  const double exchanged = omp_get_wtime();

  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      setup.sent.enter(static_cast<int>(r), bricks_of(asked[r].items()));
      if (!plan.missing[r].empty()) setup.cache.put(static_cast<int>(r), plan.missing[r], values[r].items());
    }
    compute_faces(setup, plan.faces.local, outcome);
    compute_faces(setup, plan.faces.crossing, outcome);
  });
  outcome.seconds.voxelize = voxelized - start;
  outcome.seconds.exchange = exchanged - voxelized;
  outcome.seconds.compute = omp_get_wtime() - exchanged;
  return outcome;
}

}  // namespace footwall::extract
