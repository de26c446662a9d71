// The messages of each exchange strategy.
#include <algorithm>

#include "engine/extract/replay/replay.h"
#include "engine/extract/replay/trace_bits.h"
#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::int64_t kCoordinates = 12;
constexpr std::int64_t kValue = 4;

class Ledger {
 public:
  explicit Ledger(int ranks) { sent_.of_rank.resize(static_cast<std::size_t>(ranks)); }
  void message(int from, int to, std::int64_t bytes) {
    Traffic& sender = sent_.of_rank[static_cast<std::size_t>(from)];
    Traffic& receiver = sent_.of_rank[static_cast<std::size_t>(to)];
    sender.bytes_out += bytes;
    receiver.bytes_in += bytes;
    ++sender.messages_out;
    ++receiver.messages_in;
    sent_.bytes += bytes;
    ++sent_.messages;
  }
  Sent& sent() { return sent_; }

 private:
  Sent sent_;
};

enum class Kind : std::uint8_t { kMinimum, kBlock, kBounding, kPush };

// How a rank's wants become messages.
class Wants {
 public:
  Wants(const comm::RankGrid& grid, Kind kind, std::int64_t side, int reach)
      : grid_(grid),
        kind_(kind),
        side_(side),
        reach_(reach),
        wanted_(grid.dims()),
        pillar_(kind == Kind::kBlock ? grid.dims() : survey::Index{0, 0, 0}),
        of_owner_(static_cast<std::size_t>(grid.ranks())) {}

  void send_to(int receiver, std::span<const Face> faces, const std::vector<std::uint32_t>& its,
               Ledger& ledger) {
    const survey::Box survey{{0, 0, 0}, grid_.dims()};
    for (const std::uint32_t n : its) {
      if (kind_ == Kind::kBounding) {
        survey::Box box = survey::intersection(voxelize::bounding_voxels(faces[n].triangle), survey);
        if (box.empty()) continue;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          box.lo[axis] -= reach_;
          box.hi[axis] += reach_;
        }
        wanted_.add(box);
      } else {
        voxelize::exact_rows(faces[n].triangle, survey, scratch_, wanted_);
      }
    }
    if (kind_ != Kind::kBounding) wanted_.grow(reach_);
    forget_held(receiver);
    count_by_owner();
    for (int owner = 0; owner < grid_.ranks(); ++owner) {
      Counts& counts = of_owner_[static_cast<std::size_t>(owner)];
      if (counts.asked > 0) {
        if (kind_ == Kind::kMinimum || kind_ == Kind::kBlock)
          ledger.message(receiver, owner, kCoordinates * counts.asked);
        ledger.message(owner, receiver, kValue * counts.sent);
        ledger.sent().voxels += counts.sent;
      }
      counts = {};
    }
    wanted_.clear();
  }

 private:
  struct Counts {
    std::int64_t asked = 0;
    std::int64_t sent = 0;
  };

  // Whether `receiver` has the trace in memory: its own, or in the halo of one of its pillars.
  bool holds(int receiver, std::int64_t i, std::int64_t j) const {
    for (std::int64_t a = std::max<std::int64_t>(0, i - 1); a <= std::min(grid_.dims()[0] - 1, i + 1); ++a) {
      for (std::int64_t b = std::max<std::int64_t>(0, j - 1); b <= std::min(grid_.dims()[1] - 1, j + 1);
           ++b) {
        if (grid_.owner({a, b, 0}) == receiver) return true;
      }
    }
    return false;
  }

  void forget_held(int receiver) {
    for (survey::Box box : grid_.boxes(receiver)) {
      box = survey::intersection(survey::grown(box, 1), wanted_.touched());
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          std::fill_n(wanted_.trace(i, j), wanted_.words(), std::uint64_t{0});
        }
      }
    }
    receiver_ = receiver;
  }

  // Pillar by pillar, since blocks are clipped to the pillar that a voxel lies in.
  void count_by_owner() {
    const survey::Box touched = wanted_.touched();
    if (touched.empty()) return;
    const auto [rows, columns] = grid_.lines();
    for (std::int64_t a = touched.lo[0] / rows; a <= (touched.hi[0] - 1) / rows; ++a) {
      for (std::int64_t b = touched.lo[1] / columns; b <= (touched.hi[1] - 1) / columns; ++b) {
        const survey::Box pillar = survey::intersection(
            {{a * rows, b * columns, 0}, {(a + 1) * rows, (b + 1) * columns, grid_.dims()[2]}},
            {{0, 0, 0}, grid_.dims()});
        const int owner = grid_.owner(pillar.lo);
        if (owner == receiver_) continue;
        Counts& counts = of_owner_[static_cast<std::size_t>(owner)];
        const std::int64_t asked = count(wanted_, survey::intersection(pillar, touched));
        counts.asked += asked;
        counts.sent += kind_ == Kind::kBlock && asked > 0 ? blocks_in(pillar) : asked;
      }
    }
  }

  static std::int64_t count(const TraceBits& bits, const survey::Box& box) {
    std::int64_t sum = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) sum += bits.count(i, j);
    }
    return sum;
  }

  // The voxels of the blocks around those asked for in a pillar that the receiver does not hold.
  std::int64_t blocks_in(const survey::Box& pillar) {
    const survey::Box part = survey::intersection(pillar, wanted_.touched());
    pillar_.copy(wanted_, part);
    pillar_.add_blocks(side_);
    const survey::Box around = survey::intersection(pillar_.touched(), pillar);
    std::int64_t sum = 0;
    for (std::int64_t i = around.lo[0]; i < around.hi[0]; ++i) {
      for (std::int64_t j = around.lo[1]; j < around.hi[1]; ++j) {
        if (!holds(receiver_, i, j)) sum += pillar_.count(i, j);
      }
    }
    pillar_.clear();
    return sum;
  }

  const comm::RankGrid& grid_;
  Kind kind_;
  std::int64_t side_;
  int reach_;
  int receiver_ = 0;
  TraceBits wanted_;
  TraceBits pillar_;
  std::vector<Counts> of_owner_;
  voxelize::ExactScratch scratch_;
};

// `reduce`: every owner folds its voxels of a face (they have their halo with them) and sends the sum.
Sent reduced(const Amounts& amounts) {
  Ledger ledger(amounts.ranks);
  for (const Pair& pair : amounts.pairs) ledger.message(pair.from, pair.to, pair.pieces * kPartialBytes);
  ledger.sent().at_owners = true;
  return ledger.sent();
}

Kind kind_of(const Choice& strategy) {
  if (strategy.name == "minimum") return Kind::kMinimum;
  if (strategy.name == "block") return Kind::kBlock;
  if (strategy.name == "bounding") return Kind::kBounding;
  if (strategy.name == "push") return Kind::kPush;
  throw Error(ErrorCode::kUsage, "exchange '" + strategy.text() + "' cannot be replayed",
              "choose one of: minimum, block, bounding, push, reduce");
}

}  // namespace

double Sent::busiest(const MachineCosts& costs) const {
  double most = 0;
  for (const Traffic& rank : of_rank) {
    most = std::max({most,
                     static_cast<double>(rank.bytes_out) * costs.byte +
                         static_cast<double>(rank.messages_out) * costs.message,
                     static_cast<double>(rank.bytes_in) * costs.byte +
                         static_cast<double>(rank.messages_in) * costs.message});
  }
  return most;
}

Sent sent_by(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
             std::span<const int> responsible, const Choice& strategy, int reach, const JobContext& job) {
  if (strategy.name == "reduce") return reduced(amounts_of(grid, faces, pieces, responsible));
  const Kind kind = kind_of(strategy);
  require(responsible.size() == faces.size() && pieces.first.size() == faces.size() + 1,
          "pieces and a rank for every face");
  constexpr std::int64_t kLargestBlock = 1024;
  const std::int64_t side = strategy.whole(0, "block side", 1, 1, kLargestBlock);
  std::vector<std::vector<std::uint32_t>> faces_of(static_cast<std::size_t>(grid.ranks()));
  for (std::size_t n = 0; n < faces.size(); ++n) {
    faces_of.at(static_cast<std::size_t>(responsible[n])).push_back(static_cast<std::uint32_t>(n));
  }
  Ledger ledger(grid.ranks());
  Wants wants(grid, kind, side, reach);
  for (int rank = 0; rank < grid.ranks(); ++rank) {
    job.check();
    wants.send_to(rank, faces, faces_of[static_cast<std::size_t>(rank)], ledger);
  }
  ledger.sent().exact = true;
  return ledger.sent();
}

}  // namespace footwall::extract
