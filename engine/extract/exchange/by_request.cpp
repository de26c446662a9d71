#include "engine/extract/exchange/by_request.h"

#include "engine/comm/transfer.h"
#include "engine/extract/cache/brick_values.h"
#include "engine/extract/exchange/compute_faces.h"
#include "engine/extract/exchange/phases.h"
#include "engine/extract/exchange/wanted_voxels.h"

namespace footwall::extract {
namespace {

constexpr int kRequests = 2;
constexpr int kAnswers = 3;

// Kinds of messages.
enum Kind : std::size_t { kAsking, kBeingAsked, kAnswering, kAnswered };

// What this rank asks of each other.
struct Plan {
  OwnFaces faces;
  ListPerRank missing;
  MessagePerRank<Coordinates> requests;
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
  for (std::size_t r = 0; r < plan.missing.size(); ++r) {
    const BrickList& list = plan.missing[r];
    const auto voxels = static_cast<std::size_t>(voxels_in(list));
    plan.requests.push_back(setup.kept.messages.of<Coordinates>(kAsking, r, voxels));
    coordinates_of(list, plan.requests.back().items);
  }
  return plan;
}

}  // namespace

Outcome exchange_by_request(const Setup& setup, std::int64_t side) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const auto ranks = static_cast<std::size_t>(world.size());
  Phases phases(setup);
  const Plan plan = world.collectively([&] { return plan_of(setup, side); });
  phases.enter(&Seconds::exchange);

  MessagePerRank<Coordinates> asked(ranks);
  MessagePerRank<float> answers(ranks);
  MessagePerRank<float> values(ranks);
  if (ranks > 1) {
    phases.meet();
    std::vector<std::uint64_t> asking(ranks);
    for (std::size_t r = 0; r < ranks; ++r) asking[r] = plan.requests[r].size();
    const std::vector<std::uint64_t> being_asked = comm::exchange_sizes(world, asking);
    phases.enter(&Seconds::compute);
    world.collectively([&] {
      for (std::size_t r = 0; r < ranks; ++r) {
        asked[r] = setup.kept.messages.of<Coordinates>(kBeingAsked, r, being_asked[r]);
        answers[r] = setup.kept.messages.of<float>(kAnswering, r, being_asked[r]);
        values[r] = setup.kept.messages.of<float>(kAnswered, r, asking[r]);
      }
    });
    phases.enter(&Seconds::exchange);
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
    const auto look_up = [&](std::size_t r) {
      phases.enter(&Seconds::compute);
      gather(setup.blocks, std::span<const Coordinates>(asked[r].items), answers[r].items);
      phases.enter(&Seconds::exchange);
    };
    if (phases.apart()) {
      requests.wait();
      phases.meet();
      for (std::size_t r = 0; r < ranks; ++r) look_up(r);
      phases.meet();
      for (std::size_t r = 0; r < ranks; ++r) replies.send(static_cast<int>(r), answers[r].bytes());
    } else {
      while (const std::optional<int> from = requests.next_received()) {
        look_up(static_cast<std::size_t>(*from));
        replies.send(*from, answers[static_cast<std::size_t>(*from)].bytes());
      }
      requests.wait();
    }
    replies.wait();
    phases.meet();
  }
  phases.enter(&Seconds::compute);

  world.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      setup.sent.enter(static_cast<int>(r), bricks_of(asked[r].items));
      if (!plan.missing[r].empty()) setup.cache.put(static_cast<int>(r), plan.missing[r], values[r].items);
    }
    compute_faces(setup, plan.faces.local, outcome);
    compute_faces(setup, plan.faces.crossing, outcome);
  });
  outcome.seconds = phases.end();
  return outcome;
}

}  // namespace footwall::extract
