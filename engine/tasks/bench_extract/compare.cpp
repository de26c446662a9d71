#include "engine/tasks/bench_extract/compare.h"

#include <fmt/format.h>

namespace footwall::tasks {
namespace {

const StrategyPair kAuto{"auto", "auto"};

const BenchCell* fastest_of_seed(const BenchResult& result, int benchmark, int ranks) {
  const BenchCell* best = nullptr;
  for (const BenchCell& cell : result.cells) {
    if (cell.benchmark != benchmark || cell.ranks != ranks || !is_of_seed(cell.pair)) continue;
    if (best == nullptr || cell.median(&BenchRun::slowest_rank) < best->median(&BenchRun::slowest_rank))
      best = &cell;
  }
  return best;
}

}  // namespace

std::vector<AutoAgainstSeed> auto_against_seed(const BenchResult& result) {
  std::vector<AutoAgainstSeed> all;
  for (const int benchmark : result.benchmarks()) {
    for (const int ranks : result.ranks()) {
      const BenchCell* seed = fastest_of_seed(result, benchmark, ranks);
      const BenchCell* automatic = result.find(benchmark, ranks, kAuto);
      if (ranks == 1 || seed == nullptr || automatic == nullptr) continue;
      AutoAgainstSeed one{benchmark, ranks, seed->pair, seed->median(&BenchRun::slowest_rank),
                          automatic->median(&BenchRun::slowest_rank)};
      one.time_ratio = one.seconds > 0 ? one.auto_seconds / one.seconds : 0;
      const auto ratio = [](double pair, double ours) { return ours > 0 ? pair / ours : 0; };
      one.exchange_ratio =
          ratio(seed->median_apart(&BenchRun::exchange), automatic->median_apart(&BenchRun::exchange));
      one.waiting_exchange_ratio =
          ratio(seed->median(&BenchRun::exchange), automatic->median(&BenchRun::exchange));
      all.push_back(one);
    }
  }
  return all;
}

std::optional<double> exchange_model(const BenchResult& result, const BenchCell& cell) {
  const extract::MachineRates* rates = result.rates_of(cell.ranks);
  if (rates == nullptr || cell.ranks == 1) return std::nullopt;
  return cell.median(&BenchRun::most_bytes) * rates->byte +
         cell.median(&BenchRun::most_messages) * rates->alpha;
}

std::vector<Table> comparison_tables(const BenchResult& result) {
  Table against{"auto against the fastest of the seed's pairs",
                {"benchmark", "ranks", "fastest seed pair", "s", "auto s", "auto / seed",
                 "exchange, seed / auto", "with waiting"},
                {}};
  for (const AutoAgainstSeed& one : auto_against_seed(result)) {
    against.rows.push_back({std::to_string(one.benchmark), std::to_string(one.ranks), name_of(one.fastest),
                            fmt::format("{:.4f}", one.seconds), fmt::format("{:.4f}", one.auto_seconds),
                            fmt::format("{:.3f}", one.time_ratio), fmt::format("{:.1f}", one.exchange_ratio),
                            fmt::format("{:.1f}", one.waiting_exchange_ratio)});
  }
  Table model{"Exchange of the seed's strategies, apart, over bytes / bandwidth + alpha x messages",
              {"exchange, balance", "benchmark", "ranks", "measured s", "model s", "measured / model"},
              {}};
  for (const BenchCell& cell : result.cells) {
    const std::optional<double> seconds = exchange_model(result, cell);
    if (!seconds || !is_of_seed(cell.pair)) continue;
    const double measured = cell.median_apart(&BenchRun::exchange);
    model.rows.push_back({name_of(cell.pair), std::to_string(cell.benchmark), std::to_string(cell.ranks),
                          fmt::format("{:.4f}", measured), fmt::format("{:.4f}", *seconds),
                          *seconds > 0 ? fmt::format("{:.2f}", measured / *seconds) : ""});
  }
  Table rates{"Measured among the ranks",
              {"ranks", "cores", "latency us", "each further message us", "GB/s", "voxelize ns", "look up ns",
               "fold ns", "pack ns"},
              {}};
  constexpr double kMicro = 1e6;
  constexpr double kNano = 1e9;
  for (const extract::MachineRates& r : result.rates) {
    const auto nanos = [](double seconds) { return fmt::format("{:.2f}", kNano * seconds); };
    rates.rows.push_back({std::to_string(r.ranks), std::to_string(r.cores),
                          fmt::format("{:.2f}", kMicro * r.alpha), fmt::format("{:.2f}", kMicro * r.overhead),
                          r.byte > 0 ? fmt::format("{:.2f}", 1 / (kNano * r.byte)) : "", nanos(r.voxelize),
                          nanos(r.gather), nanos(r.fold), nanos(r.pack)});
  }
  std::vector<Table> tables;
  for (Table* table : {&against, &model, &rates}) {
    if (!table->rows.empty()) tables.push_back(std::move(*table));
  }
  return tables;
}

}  // namespace footwall::tasks
