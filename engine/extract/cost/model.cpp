#include "engine/extract/cost/model.h"

#include <algorithm>
#include <array>
#include <optional>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr double kValueBytes = 4;
constexpr double kCoordinateBytes = 12;

// The work of every rank in one phase, and how long it takes on the cores there are.
class Phase {
 public:
  Phase(const Workload& workload, const MachineRates& rates) : cores_(rates.cores) {
    threads_ = std::min(workload.threads, rates.cores);
  }
  void add(double work) {
    most_ = std::max(most_, work);
    sum_ += work;
  }
  double seconds() const { return std::max(most_ / threads_, sum_ / cores_); }

 private:
  double cores_;
  double threads_ = 1;
  double most_ = 0;
  double sum_ = 0;
};

struct Moved {
  double received, sent;  // voxels
};

std::optional<std::size_t> block_place(const Choice& exchange) {
  constexpr std::int64_t kMostSide = 1 << 10;
  constexpr std::int64_t kUsualSide = 2;  // as in the seed's runs
  const std::int64_t side = exchange.whole(0, "side", kUsualSide, 1, kMostSide);
  const auto* const found = std::find(kBlockSides.begin(), kBlockSides.end(), side);
  if (found == kBlockSides.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kBlockSides.begin());
}

Moved moved_by(const Choice& exchange, const RankAmounts& rank, double cached) {
  const double fresh = 1 - cached;
  if (exchange.name == "bounding") return {fresh * rank.bounding_received, fresh * rank.bounding_sent};
  if (exchange.name == "block") {
    if (const auto place = block_place(exchange))
      return {fresh * rank.blocks_received[*place], fresh * rank.blocks_sent[*place]};
  }
  return {fresh * rank.received, fresh * rank.sent};
}

// What every strategy that brings the voxels to the responsible rank does with them there.
double computing(const RankAmounts& rank, const Workload& workload, const MachineRates& rates) {
  double voxel = rates.gather + workload.whole_face;
  if (workload.discontinuity) voxel += std::max(0.0, rates.fold_discontinuity - rates.fold);
  return voxel * rank.voxels + rates.finish * rank.faces;
}

// 3.17 and, with blocks, 3.20: voxelize; ask, by coordinates; answer; compute.
Seconds by_request(const Choice& exchange, const Workload& workload, const MachineRates& rates) {
  Phase voxelize(workload, rates);
  Phase pack(workload, rates);
  Phase compute(workload, rates);
  double bytes = 0;
  for (const RankAmounts& rank : workload.ranks) {
    const Moved moved = moved_by(exchange, rank, workload.cached);
    voxelize.add(rates.face * rank.faces + rates.voxelize * rank.voxels);
    pack.add(rates.pack * (2 * moved.received + moved.sent));  // k2 and k4, and k3 of the seed
    compute.add(computing(rank, workload, rates));
    bytes = std::max(bytes, (kCoordinateBytes + kValueBytes) * std::max(moved.received, moved.sent));
  }
  // Requests and answers, each with its size before it, to every other rank.
  const auto others = static_cast<double>(workload.ranks.size() - 1);
  const double latency = others > 0 ? 2 * (2 * rates.alpha + 2 * others * rates.overhead) : 0;
  return {.voxelize = voxelize.seconds(),
          .exchange = latency + rates.byte * bytes,
          .compute = compute.seconds() + pack.seconds()};
}

// 3.30: send the bounding volumes, voxelize meanwhile, compute.
Seconds by_volume(const Choice& exchange, const Workload& workload, const MachineRates& rates) {
  Phase voxelize(workload, rates);
  Phase pack(workload, rates);
  Phase compute(workload, rates);
  double bytes = 0;
  double partners = 0;
  for (const RankAmounts& rank : workload.ranks) {
    const Moved moved = moved_by(exchange, rank, workload.cached);
    voxelize.add(rates.face * rank.faces + rates.voxelize * rank.voxels);
    pack.add(rates.pack * (moved.received + moved.sent));
    compute.add(computing(rank, workload, rates));
    bytes = std::max(bytes, (kCoordinateBytes + kValueBytes) * std::max(moved.received, moved.sent));
    partners = std::max({partners, rank.partners_received, rank.partners_sent});
  }
  // The transfer overlaps the voxelizing; what is left of it is the exchange.
  const double transfer = partners > 0 ? rates.alpha + rates.overhead * partners + rates.byte * bytes : 0;
  const double left = std::max(0.0, transfer - voxelize.seconds());
  return {.voxelize = voxelize.seconds(), .exchange = left, .compute = compute.seconds() + pack.seconds()};
}

// Owners voxelize what others are responsible for and send the values in that order; receivers voxelize
// their faces and take them.
Seconds by_push(const Choice& exchange, const Workload& workload, const MachineRates& rates) {
  Phase voxelize(workload, rates);
  Phase pack(workload, rates);
  Phase compute(workload, rates);
  double bytes = 0;
  double partners = 0;
  for (const RankAmounts& rank : workload.ranks) {
    const Moved moved = moved_by(exchange, rank, workload.cached);
    voxelize.add(rates.face * (rank.faces + rank.pieces_sent) +
                 rates.voxelize * (rank.voxels + rank.owned_elsewhere));
    pack.add(rates.pack * (moved.received + moved.sent));
    compute.add(computing(rank, workload, rates));
    bytes = std::max(bytes, kValueBytes * std::max(moved.received, moved.sent));
    partners = std::max({partners, rank.partners_received, rank.partners_sent});
  }
  const double transfer = partners > 0 ? rates.alpha + rates.overhead * partners + rates.byte * bytes : 0;
  return {
      .voxelize = voxelize.seconds(), .exchange = transfer, .compute = compute.seconds() + pack.seconds()};
}

// Owners fold what they own, and send sums.
Seconds by_reduce(const Choice& /*exchange*/, const Workload& workload, const MachineRates& rates) {
  Phase fold(workload, rates);
  Phase pack(workload, rates);
  Phase finish(workload, rates);
  double bytes = 0;
  double partners = 0;
  for (const RankAmounts& rank : workload.ranks) {
    fold.add(rates.face * rank.owned_faces +
             (workload.discontinuity ? rates.fold_discontinuity : rates.fold) * rank.owned);
    pack.add(rates.finish * (rank.pieces_received + rank.pieces_sent));
    finish.add(rates.finish * rank.faces);
    bytes = std::max(bytes, kPartialSumBytes * std::max(rank.pieces_received, rank.pieces_sent));
    partners = std::max({partners, rank.partners_received, rank.partners_sent});
  }
  const double transfer = partners > 0 ? rates.alpha + rates.overhead * partners + rates.byte * bytes : 0;
  return {.voxelize = fold.seconds(), .exchange = transfer, .compute = finish.seconds() + pack.seconds()};
}

struct Model {
  std::string_view exchange;
  Seconds (*seconds)(const Choice& exchange, const Workload& workload, const MachineRates& rates);
};
constexpr std::array kModels{Model{"minimum", &by_request}, Model{"block", &by_request},
                             Model{"bounding", &by_volume}, Model{"push", &by_push},
                             Model{"reduce", &by_reduce}};

const Model* model_of(const Choice& exchange) {
  const auto* const found = std::find_if(kModels.begin(), kModels.end(),
                                         [&](const Model& each) { return each.exchange == exchange.name; });
  if (found == kModels.end()) return nullptr;
  if (exchange.name != "block" || exchange.text() == "block=1" || block_place(exchange)) return found;
  return nullptr;
}

}  // namespace

bool has_model(const Choice& exchange) {
  return model_of(exchange) != nullptr;
}

Seconds predict(const Choice& exchange, const Workload& workload, const MachineRates& rates) {
  const Model* const model = model_of(exchange);
  require(model != nullptr && !workload.ranks.empty(), "an exchange strategy with a model");
  Seconds seconds = model->seconds(exchange, workload, rates);
  seconds.total = seconds.voxelize + seconds.exchange + seconds.compute;
  return seconds;
}

}  // namespace footwall::extract
