#include "engine/tasks/bench_extract/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/tasks/bench_extract/published.h"

namespace footwall::tasks {
namespace {

constexpr double kMega = 1e6;

const PublishedRow* published_row(std::span<const PublishedRow> rows, const StrategyPair& pair) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const PublishedRow& row) {
    return (row.exchange.empty() || row.exchange == pair.exchange) && row.balance == pair.balance;
  });
  return found == rows.end() ? nullptr : &*found;
}

// " [43.83]", " [>750]", or nothing.
std::string beside(const PublishedRow* row, int ranks, double divided_into, int digits) {
  const double* value = row == nullptr ? nullptr : published_value(*row, ranks);
  if (value == nullptr) return "";
  const bool more = *value < 0;
  const double amount = more ? -*value : *value;
  if (divided_into <= 0) return fmt::format(" [{}{:.{}f}]", more ? ">" : "", amount, digits);
  return fmt::format(" [{}{:.{}f}]", more ? "<" : "", divided_into / amount, digits);
}

// A table with a row for each pair and a column for each number of ranks.
template <typename Word>
Table table_of(const BenchResult& result, int benchmark, std::string title, Word&& word) {
  Table table{std::move(title), {"exchange, balance", "seed"}, {}};
  for (const int ranks : result.ranks()) table.header.push_back(fmt::format("{} ranks", ranks));
  for (const StrategyPair& pair : result.pairs()) {
    const PublishedRow* row = published_row(published_seconds(benchmark), pair);
    std::vector<std::string> words{name_of(pair), row == nullptr ? "" : std::string(row->name)};
    bool any = false;
    for (const int ranks : result.ranks()) {
      const BenchCell* cell = result.find(benchmark, ranks, pair);
      any = any || cell != nullptr;
      words.push_back(cell == nullptr ? "" : word(*cell, row));
    }
    if (any) table.rows.push_back(std::move(words));
  }
  return table;
}

Table seconds_table(const BenchResult& result, int benchmark) {
  Table table = table_of(
      result, benchmark,
      fmt::format("Benchmark {}: seconds of the slowest rank, median of the runs, [seed, table F.{}]",
                  benchmark, benchmark),
      [](const BenchCell& cell, const PublishedRow* row) {
        return fmt::format("{:.4f}{}", cell.median(&BenchRun::slowest_rank), beside(row, cell.ranks, 0, 2));
      });
  if (const BenchCell* serial = result.serial(benchmark)) {
    std::vector<std::string> words(table.header.size());
    words[0] = "best serial run: " + name_of(serial->pair);
    words[1] = "Serial";
    words[2] = fmt::format("{:.4f} [{:.2f}]", serial->median(&BenchRun::slowest_rank),
                           published_serial_seconds(benchmark));
    table.rows.insert(table.rows.begin(), std::move(words));
  }
  return table;
}

Table speedup_table(const BenchResult& result, int benchmark, double serial) {
  return table_of(
      result, benchmark,
      fmt::format("Benchmark {}: speedup over the best serial run (efficiency), [seed, table 5.{}]",
                  benchmark, benchmark),
      [&](const BenchCell& cell, const PublishedRow* row) {
        const double speedup = serial / cell.median(&BenchRun::slowest_rank);
        return fmt::format("{:.2f} ({:.2f}){}", speedup, speedup / cell.ranks,
                           beside(row, cell.ranks, published_serial_seconds(benchmark), 2));
      });
}

Table rank_table(const BenchResult& result, int benchmark) {
  return table_of(
      result, benchmark,
      fmt::format(
          "Benchmark {}: seconds per repeat of the slowest / the quickest rank (spread of the runs in %)",
          benchmark),
      [&](const BenchCell& cell, const PublishedRow*) {
        const double slowest = cell.median(&BenchRun::slowest_rank);
        constexpr double kPercent = 100;
        return fmt::format(
            "{:.4f} / {:.4f} ({:.0f})", slowest / result.repeats,
            cell.median(&BenchRun::quickest_rank) / result.repeats,
            kPercent * (cell.most(&BenchRun::slowest_rank) - cell.least(&BenchRun::slowest_rank)) / slowest);
      });
}

Table phase_table(const BenchResult& result, int benchmark) {
  constexpr double kMilli = 1e3;
  Table table{
      fmt::format("Benchmark {}: phases of an EXTRACT-ALL, apart, ms of the slowest rank in each; amounts of "
                  "an EXTRACT-ALL over all ranks",
                  benchmark),
      {"exchange, balance", "ranks", "balance", "voxelize", "exchange", "compute", "wait", "MB", "messages",
       "load max/mean"},
      {}};
  for (const BenchCell& cell : result.cells) {
    if (cell.benchmark != benchmark) continue;
    const auto each = [&](double BenchRun::*of) { return cell.median_apart(of) / result.extracts; };
    table.rows.push_back({name_of(cell.pair), std::to_string(cell.ranks),
                          fmt::format("{:.3f}", kMilli * each(&BenchRun::balance)),
                          fmt::format("{:.3f}", kMilli * each(&BenchRun::voxelize)),
                          fmt::format("{:.3f}", kMilli * each(&BenchRun::exchange)),
                          fmt::format("{:.3f}", kMilli * each(&BenchRun::compute)),
                          fmt::format("{:.3f}", kMilli * each(&BenchRun::wait)),
                          fmt::format("{:.3f}", each(&BenchRun::bytes) / kMega),
                          fmt::format("{:.0f}", each(&BenchRun::messages)),
                          fmt::format("{:.3f}", cell.median(&BenchRun::load_max_over_mean))});
  }
  return table;
}

// The load does not depend on the exchange: one row for each balancer, from whichever exchange ran it first.
Table deviation_table(const BenchResult& result, int benchmark) {
  Table table{
      fmt::format("Benchmark {}: standard deviation of the load, voxel^2, [seed, table F.4]", benchmark),
      {"balance"},
      {}};
  std::vector<std::string> balancers;
  for (const StrategyPair& pair : result.pairs()) {
    if (std::find(balancers.begin(), balancers.end(), pair.balance) == balancers.end())
      balancers.push_back(pair.balance);
  }
  for (const int ranks : result.ranks()) table.header.push_back(fmt::format("{} ranks", ranks));
  for (const std::string& balancer : balancers) {
    std::vector<std::string> words{balancer};
    const PublishedRow* row = published_row(published_deviations(), {"", balancer});
    for (const int ranks : result.ranks()) {
      const auto cell = std::find_if(result.cells.begin(), result.cells.end(), [&](const BenchCell& each) {
        return each.benchmark == benchmark && each.ranks == ranks && each.pair.balance == balancer;
      });
      words.push_back(
          cell == result.cells.end()
              ? ""
              : fmt::format("{:.0f}{}", cell->median(&BenchRun::load_deviation), beside(row, ranks, 0, 0)));
    }
    table.rows.push_back(std::move(words));
  }
  return table;
}

}  // namespace

std::vector<Table> benchmark_tables(const BenchResult& result) {
  constexpr int kOfTableF4 = 2;
  std::vector<Table> tables;
  for (const int benchmark : result.benchmarks()) {
    tables.push_back(seconds_table(result, benchmark));
    if (const BenchCell* serial = result.serial(benchmark))
      tables.push_back(speedup_table(result, benchmark, serial->median(&BenchRun::slowest_rank)));
    tables.push_back(rank_table(result, benchmark));
    tables.push_back(phase_table(result, benchmark));
    if (benchmark == kOfTableF4) tables.push_back(deviation_table(result, benchmark));
  }
  return tables;
}

}  // namespace footwall::tasks
