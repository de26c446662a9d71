#include "engine/extract/balance/minimal.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

#include "engine/extract/balance/start.h"
#include "engine/extract/balance/voxel_weights.h"
#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

struct Weighed {
  std::int64_t weight = 0;
  std::uint32_t place = 0;  // by id
  std::uint32_t face = 0;
  // Largest first out of a heap, ties by id.
  friend bool operator<(const Weighed& a, const Weighed& b) {
    return std::tie(a.weight, b.place) < std::tie(b.weight, a.place);
  }
};

struct Move {
  std::uint32_t face = 0;
  int from = 0;
  int to = 0;
};

// One attempt at a slack, from the same loads.
class Plan {
 public:
  Plan(const BalanceInput& input, const std::vector<std::int64_t>& loads, std::int64_t mean,
       std::int64_t slack)
      : input_(input), loads_(loads), mean_(mean), most_(mean + slack) {
    for (int rank = 0; rank < input.grid.ranks(); ++rank) {
      if (load(rank) < mean) emptiest_.emplace(load(rank), rank);
    }
  }

  // Gives away of `faces`, a heap, what takes the rank down to the mean and its slack.
  void relieve(int giver, std::vector<Weighed>& faces) {
    auto end = faces.end();
    while (load(giver) > most_ && end != faces.begin()) {
      std::pop_heap(faces.begin(), end);
      const Weighed face = *--end;
      if (face.weight > load(giver) - mean_) continue;
      const int to = receiver(giver, face);
      if (to < 0) continue;
      load(giver) -= face.weight;
      load(to) += face.weight;
      moves_.push_back({face.face, giver, to});
      moved_ += face.weight;
    }
  }

  std::int64_t largest_load() const { return *std::max_element(loads_.begin(), loads_.end()); }
  std::int64_t moved() const { return moved_; }
  const std::vector<Move>& moves() const { return moves_; }

 private:
  using Entry = std::pair<std::int64_t, int>;  // load, rank

  std::int64_t& load(int rank) { return loads_[static_cast<std::size_t>(rank)]; }
  bool has_room(int rank, const Weighed& face) {
    return load(rank) < mean_ && load(rank) + face.weight <= most_;
  }

  int receiver(int giver, const Weighed& face) {
    const survey::Box box = voxelize::bounding_voxels(input_.faces[face.face].triangle);
    if (const int owner = owner_with_room(box, face); owner >= 0) return owner;
    if (input_.cache != nullptr && !input_.cache->empty()) {
      for (int rank = 0; rank < input_.grid.ranks(); ++rank) {
        if (has_room(rank, face) && input_.cache->holds(rank, box)) return rank;
      }
    }
    if (const int near = near_with_room(giver, face); near >= 0) return near;
    return emptiest(giver, face);
  }

  // Of the owners of traces in the face's box the one with most of them; -1: none has room.
  int owner_with_room(const survey::Box& box, const Weighed& face) {
    const comm::RankGrid& grid = input_.grid;
    const survey::Box inside = survey::intersection(box, {{0, 0, 0}, grid.dims()});
    if (inside.empty()) return -1;
    const auto [rows, columns] = grid.lines();
    int best = -1;
    std::int64_t most = 0;
    for (std::int64_t a = inside.lo[0] / rows; a <= (inside.hi[0] - 1) / rows; ++a) {
      for (std::int64_t b = inside.lo[1] / columns; b <= (inside.hi[1] - 1) / columns; ++b) {
        const int rank = grid.owner({a * rows, b * columns, 0});
        if (!has_room(rank, face)) continue;
        const std::int64_t traces =
            (std::min(inside.hi[0], (a + 1) * rows) - std::max(inside.lo[0], a * rows)) *
            (std::min(inside.hi[1], (b + 1) * columns) - std::max(inside.lo[1], b * columns));
        if (traces > most || (traces == most && rank < best)) {
          most = traces;
          best = rank;
        }
      }
    }
    return best;
  }

  int near_with_room(int giver, const Weighed& face) {
    constexpr int kNear = 2;
    const auto [rows, columns] = input_.grid.parts();
    const auto [row, column] = input_.grid.place(giver);
    for (int distance = 1; distance <= kNear; ++distance) {
      for (int da = -distance; da <= distance; ++da) {
        const int aside = distance - std::abs(da);
        for (const int db : {-aside, aside}) {
          const int a = row + da;
          const int b = column + db;
          if (a < 0 || a >= rows || b < 0 || b >= columns) continue;
          const int rank = a * columns + b;
          if (has_room(rank, face)) return rank;
        }
      }
    }
    return -1;
  }

  // The emptiest rank below the mean, if it has room or ends up below the giver; -1: it would not.
  int emptiest(int giver, const Weighed& face) {
    while (!emptiest_.empty()) {
      const auto [then, rank] = emptiest_.top();
      const std::int64_t now = load(rank);
      if (now == then) {
        return now + face.weight <= most_ || now + face.weight < load(giver) ? rank : -1;
      }
      emptiest_.pop();  // loads only rise here, so that an old entry stands too early, never too late
      if (now < mean_) emptiest_.emplace(now, rank);
    }
    return -1;
  }

  const BalanceInput& input_;
  std::vector<std::int64_t> loads_;
  std::int64_t mean_;
  std::int64_t most_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> emptiest_;
  std::vector<Move> moves_;
  std::int64_t moved_ = 0;
};

// What the moves add to the messages of the busiest rank, at most: no voxel of a moved face is at its new
// rank, and each rank with voxels of it becomes a new partner.
std::int64_t cost_of(const BalanceInput& input, const std::vector<Move>& moves,
                     const std::vector<std::int64_t>& weights) {
  const comm::RankGrid& grid = input.grid;
  std::vector<std::int64_t> voxels(static_cast<std::size_t>(grid.ranks()), 0);
  std::vector<std::int64_t> partners(voxels.size(), 0);
  for (const Move& move : moves) {
    voxels[static_cast<std::size_t>(move.from)] += weights[move.face];
    voxels[static_cast<std::size_t>(move.to)] += weights[move.face];
    for (const int owner : ranks_meeting(grid, voxelize::bounding_voxels(input.faces[move.face].triangle))) {
      ++partners[static_cast<std::size_t>(owner)];
      ++partners[static_cast<std::size_t>(move.to)];
    }
  }
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank < voxels.size(); ++rank) {
    most = std::max(most,
                    voxels[rank] * input.costs.remote +
                        std::min<std::int64_t>(partners[rank], 2 * (grid.ranks() - 1)) * input.costs.message);
  }
  return most;
}

// The movable faces of each rank above the mean, as heaps.
std::vector<std::vector<Weighed>> heaps_of(const BalanceInput& input, const std::vector<int>& ranks,
                                           const std::vector<std::int64_t>& weights,
                                           const std::vector<std::int64_t>& loads, std::int64_t mean) {
  std::vector<std::vector<Weighed>> heaps(loads.size());
  const std::vector<std::uint32_t> order = by_id(input.faces);
  for (std::uint32_t place = 0; place < order.size(); ++place) {
    const std::uint32_t n = order[place];
    const auto rank = static_cast<std::size_t>(ranks[n]);
    if (loads[rank] > mean && weights[n] > 0 && movable(input, n))
      heaps[rank].push_back({weights[n], place, n});
  }
  for (auto& heap : heaps) std::make_heap(heap.begin(), heap.end());
  return heaps;
}

}  // namespace

MinimalMoves minimal_moves(const BalanceInput& input) {
  require(input.voxels.empty() || input.voxels.size() == input.faces.size(), "voxels of every face");
  MinimalMoves done;
  done.responsible = starting_ranks(input);
  if (input.grid.ranks() == 1) return done;
  const std::vector<std::int64_t> weights =
      input.voxels.empty() ? voxel_weights(input.faces, input.grid.dims())
                           : std::vector<std::int64_t>(input.voxels.begin(), input.voxels.end());
  std::vector<std::int64_t> loads(static_cast<std::size_t>(input.grid.ranks()), 0);
  for (std::size_t n = 0; n < weights.size(); ++n)
    loads[static_cast<std::size_t>(done.responsible[n])] += weights[n];
  const std::int64_t mean = std::accumulate(loads.begin(), loads.end(), std::int64_t{0}) / input.grid.ranks();
  std::vector<int> givers;
  for (int rank = 0; rank < input.grid.ranks(); ++rank) {
    const std::int64_t load = loads[static_cast<std::size_t>(rank)];
    if (load > mean) givers.push_back(rank);
    done.least += std::max<std::int64_t>(0, load - mean);
  }
  std::stable_sort(givers.begin(), givers.end(), [&](int a, int b) {
    return loads[static_cast<std::size_t>(a)] > loads[static_cast<std::size_t>(b)];
  });
  const auto heaps = heaps_of(input, done.responsible, weights, loads, mean);
  const std::int64_t before = *std::max_element(loads.begin(), loads.end());

  for (const std::int64_t part : {200, 20, 5, 2, 1}) {  // a slack of mean / part
    Plan plan(input, loads, mean, mean / part);
    for (const int giver : givers) {
      std::vector<Weighed> faces = heaps[static_cast<std::size_t>(giver)];
      plan.relieve(giver, faces);
    }
    const std::int64_t gain = input.costs.horizon * input.costs.voxel * (before - plan.largest_load());
    const std::int64_t cost = cost_of(input, plan.moves(), weights);
    if (gain <= cost) continue;
    for (const Move& move : plan.moves()) done.responsible[move.face] = move.to;
    done.moved = plan.moved();
    done.gain = gain;
    done.cost = cost;
    break;
  }
  return done;
}

std::vector<int> balance_minimal(const BalanceInput& input) {
  return minimal_moves(input).responsible;
}

void check_minimal(const Choice& choice) {
  choice.takes_at_most(0);
}

}  // namespace footwall::extract
