#include "engine/extract/balance/minimal.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

#include "engine/extract/balance/start.h"
#include "engine/extract/balance/voxel_weights.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

struct Weighed {
  std::int64_t weight = 0;
  std::uint32_t place = 0;  // by id
  std::uint32_t face = 0;
};

// Largest first, ties by id.
bool before(const Weighed& a, const Weighed& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.place < b.place;
}

// The movable faces of an overloaded rank by falling weight. Only those that its surplus asks for are sorted;
// what little is left in the end is looked up among the others one by one.
class Falling {
 public:
  Falling() = default;
  Falling(std::span<Weighed> faces, std::size_t sorted) : faces_(faces), sorted_(sorted) {
    const auto middle = faces_.begin() + static_cast<std::ptrdiff_t>(sorted);
    if (middle != faces_.end()) std::nth_element(faces_.begin(), middle, faces_.end(), before);
    std::sort(faces_.begin(), middle, before);
  }

  // The first face after `last` (null: of all) that weighs at most `limit`; null where there is none. `next`
  // is the reader's place, 0 at first. Limits must not rise from call to call.
  const Weighed* after(const Weighed* last, std::int64_t limit, std::size_t& next) const {
    if (next < sorted_ && faces_[next].weight > limit) {
      const auto end = faces_.begin() + static_cast<std::ptrdiff_t>(sorted_);
      next = static_cast<std::size_t>(
          std::partition_point(faces_.begin() + static_cast<std::ptrdiff_t>(next), end,
                               [&](const Weighed& face) { return face.weight > limit; }) -
          faces_.begin());
    }
    if (next < sorted_) return &faces_[next++];
    const Weighed* best = nullptr;
    for (const Weighed& face : faces_.subspan(sorted_)) {
      if (face.weight <= limit && (last == nullptr || before(*last, face)) &&
          (best == nullptr || before(face, *best))) {
        best = &face;
      }
    }
    return best;
  }
  // The face that will probably be asked for some calls later; null: not known.
  const Weighed* ahead(std::size_t next) const {
    constexpr std::size_t kAhead = 8;
    return next + kAhead < sorted_ ? &faces_[next + kAhead] : nullptr;
  }

 private:
  std::span<Weighed> faces_;
  std::size_t sorted_ = 0;
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

  // Gives away of `faces` what takes the rank down to the mean and its slack.
  void relieve(int giver, const Falling& faces) {
    std::size_t next = 0;
    const Weighed* face = nullptr;
    while (load(giver) > most_ && (face = faces.after(face, load(giver) - mean_, next)) != nullptr) {
      // Faces lie across memory: asked for before they are needed.
      if (const Weighed* later = faces.ahead(next)) __builtin_prefetch(&input_.faces[later->face].triangle);
      const int to = receiver(giver, *face);
      if (to < 0) continue;
      load(giver) -= face->weight;
      load(to) += face->weight;
      moves_.push_back({face->face, giver, to});
      moved_ += face->weight;
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
    const survey::Box box = voxel_box(input_.faces[face.face]);
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
    const auto [along, across] = grid.parts();
    // In 32 bits: divisions are most of the work.
    const auto pillar = [](std::int64_t line, std::int64_t lines) {
      return static_cast<std::int64_t>(static_cast<std::uint32_t>(line) / static_cast<std::uint32_t>(lines));
    };
    const std::int64_t last_a = pillar(inside.hi[0] - 1, rows);
    const std::int64_t first_b = pillar(inside.lo[1], columns);
    const std::int64_t last_b = pillar(inside.hi[1] - 1, columns);
    int best = -1;
    std::int64_t most = 0;
    for (std::int64_t a = pillar(inside.lo[0], rows); a <= last_a; ++a) {
      for (std::int64_t b = first_b; b <= last_b; ++b) {
        const int rank = static_cast<int>(a < along ? a : a % along) * across +
                         static_cast<int>(b < across ? b : b % across);
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
// rank, and each rank with voxels of it becomes a new partner. Partners are only looked for where the answer,
// whether it is below `gain`, depends on them.
std::int64_t cost_of(const BalanceInput& input, const std::vector<Move>& moves,
                     const std::vector<std::int64_t>& weights, std::int64_t gain) {
  const comm::RankGrid& grid = input.grid;
  std::vector<std::int64_t> voxels(static_cast<std::size_t>(grid.ranks()), 0);
  for (const Move& move : moves) {
    voxels[static_cast<std::size_t>(move.from)] += weights[move.face];
    voxels[static_cast<std::size_t>(move.to)] += weights[move.face];
  }
  const std::int64_t most_partners = 2 * (std::int64_t{grid.ranks()} - 1);
  const std::int64_t bound = *std::max_element(voxels.begin(), voxels.end()) * input.costs.remote +
                             most_partners * input.costs.message;
  if (bound < gain || moves.empty()) return bound;
  std::vector<std::int64_t> partners(voxels.size(), 0);
  for (const Move& move : moves) {
    for (const int owner : ranks_meeting(grid, voxel_box(input.faces[move.face]))) {
      ++partners[static_cast<std::size_t>(owner)];
      ++partners[static_cast<std::size_t>(move.to)];
    }
  }
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank < voxels.size(); ++rank) {
    most = std::max(most, voxels[rank] * input.costs.remote +
                              std::min(partners[rank], most_partners) * input.costs.message);
  }
  return most;
}

// Ranks, voxels and the order of ids in one pass, since reading many faces costs more than looking at them.
struct Weights {
  std::vector<int> start;
  std::vector<std::int64_t> voxels;
  std::vector<std::int64_t> loads;
  std::int64_t mean = 0;
  std::vector<std::uint32_t> by_id;  // empty where the faces stand by id already
};

Weights weights_of(const BalanceInput& input) {
  const std::size_t count = input.faces.size();
  require(input.voxels.empty() || input.voxels.size() == count, "voxels of every face");
  Weights weights{std::vector<int>(count),
                  std::vector<std::int64_t>(input.voxels.begin(), input.voxels.end()),
                  std::vector<std::int64_t>(static_cast<std::size_t>(input.grid.ranks()), 0),
                  0,
                  {}};
  weights.voxels.resize(count);
  bool ordered = true;
  constexpr std::size_t kBlock = 256;
  for (std::size_t first = 0; first < count; first += kBlock) {
    const std::size_t block = std::min(kBlock, count - first);
    const std::span<const Face> faces = input.faces.subspan(first, block);
    starting_ranks(input, first, std::span(weights.start).subspan(first, block));
    if (input.voxels.empty())
      voxel_weights(faces, input.grid.dims(), std::span(weights.voxels).subspan(first, block));
    for (std::size_t n = first; n < first + block; ++n) {
      weights.loads[static_cast<std::size_t>(weights.start[n])] += weights.voxels[n];
      ordered = ordered && (n == 0 || id_of(input.faces[n - 1]) < id_of(input.faces[n]));
    }
  }
  if (!ordered) weights.by_id = by_id(input.faces);
  weights.mean =
      std::accumulate(weights.loads.begin(), weights.loads.end(), std::int64_t{0}) / input.grid.ranks();
  return weights;
}

// The movable faces of the ranks above the mean, one rank after the other.
class Stocks {
 public:
  Stocks(const BalanceInput& input, const Weights& weights) : falling_(weights.loads.size()) {
    std::vector<std::size_t> next(weights.loads.size() + 1, 0);
    const auto given = [&](std::size_t n) {
      return weights.loads[static_cast<std::size_t>(weights.start[n])] > weights.mean &&
             weights.voxels[n] > 0 && movable(input, n);
    };
    std::vector<std::int64_t> voxels(weights.loads.size(), 0);
    for (std::size_t n = 0; n < weights.start.size(); ++n) {
      const auto rank = static_cast<std::size_t>(weights.start[n]);
      if (!given(n)) continue;
      ++next[rank + 1];
      voxels[rank] += weights.voxels[n];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    const std::vector<std::size_t> begin = next;
    faces_.resize(next.back());
    for (std::uint32_t place = 0; place < weights.start.size(); ++place) {
      const std::uint32_t n = weights.by_id.empty() ? place : weights.by_id[place];
      if (given(n))
        faces_[next[static_cast<std::size_t>(weights.start[n])]++] = {weights.voxels[n], place, n};
    }
    for (std::size_t rank = 0; rank < falling_.size(); ++rank) {
      const std::size_t count = begin[rank + 1] - begin[rank];
      if (count == 0) continue;
      // The largest faces have more voxels than most: so many of them are enough.
      const double part =
          static_cast<double>(weights.loads[rank] - weights.mean) / static_cast<double>(voxels[rank]);
      const auto enough = static_cast<std::size_t>(std::min(1.0, part) * static_cast<double>(count));
      falling_[rank] = Falling(std::span(faces_).subspan(begin[rank], count), enough);
    }
  }
  const Falling& of(int rank) const { return falling_[static_cast<std::size_t>(rank)]; }

 private:
  std::vector<Weighed> faces_;
  std::vector<Falling> falling_;
};

}  // namespace

MinimalMoves minimal_moves(const BalanceInput& input) {
  Weights weights = weights_of(input);
  const std::vector<std::int64_t>& loads = weights.loads;
  MinimalMoves done;
  std::vector<int> givers;
  for (int rank = 0; rank < input.grid.ranks(); ++rank) {
    const std::int64_t surplus = loads[static_cast<std::size_t>(rank)] - weights.mean;
    if (surplus <= 0) continue;
    givers.push_back(rank);
    done.least += surplus;
  }
  std::stable_sort(givers.begin(), givers.end(), [&](int a, int b) {
    return loads[static_cast<std::size_t>(a)] > loads[static_cast<std::size_t>(b)];
  });
  const std::int64_t before_moves = *std::max_element(loads.begin(), loads.end());
  const Stocks stocks(input, weights);
  for (const int part : {200, 20, 5, 2, 1}) {  // a slack of mean / part
    if (givers.empty() || input.grid.ranks() == 1) break;
    Plan plan(input, loads, weights.mean, weights.mean / part);
    for (const int giver : givers) plan.relieve(giver, stocks.of(giver));
    const std::int64_t gain = input.costs.horizon * input.costs.voxel * (before_moves - plan.largest_load());
    const std::int64_t cost = cost_of(input, plan.moves(), weights.voxels, gain);
    if (gain <= cost) continue;
    for (const Move& move : plan.moves()) weights.start[move.face] = move.to;
    done.moved = plan.moved();
    done.gain = gain;
    done.cost = cost;
    break;
  }
  done.responsible = std::move(weights.start);
  return done;
}

std::vector<int> balance_minimal(const BalanceInput& input) {
  return minimal_moves(input).responsible;
}

void check_minimal(const Choice& choice) {
  choice.takes_at_most(0);
}

}  // namespace footwall::extract
