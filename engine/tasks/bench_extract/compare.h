// How `auto` stands against the seed's strategies, and how far these are from what the links allow.
#pragma once
#include <optional>
#include <vector>

#include "engine/tasks/bench_extract/results.h"
#include "engine/tasks/bench_extract/table.h"

namespace footwall::tasks {

// On one number of ranks in one benchmark.
struct AutoAgainstSeed {
  int benchmark = 1;
  int ranks = 1;
  StrategyPair fastest;     // of the seed's pairs
  double seconds = 0;       // of that pair
  double auto_seconds = 0;  // of auto, auto
  double time_ratio = 0;    // auto's over the pair's
  // The pair's exchange phase over auto's; 0 where auto's took no time. Apart, and with the waiting.
  double exchange_ratio = 0;
  double waiting_exchange_ratio = 0;
};
// Of every benchmark and number of ranks above 1 that ran both.
std::vector<AutoAgainstSeed> auto_against_seed(const BenchResult& result);

// Seconds that the exchanges of a cell would take at least: the bytes and the messages of the rank that sends
// most, at the rates measured for so many ranks (seed 004, equation 3.2). Nothing without rates.
std::optional<double> exchange_model(const BenchResult& result, const BenchCell& cell);

std::vector<Table> comparison_tables(const BenchResult& result);

}  // namespace footwall::tasks
