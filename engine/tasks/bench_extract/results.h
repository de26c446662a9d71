// What the runs of `bench extract` gave, as plain values.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/extract/cost/rates.h"

namespace footwall::tasks {

// An exchange with a balancer, as options write them.
struct StrategyPair {
  std::string exchange, balance;
  friend bool operator==(const StrategyPair&, const StrategyPair&) = default;
};
std::string name_of(const StrategyPair& pair);
// Whether the seed has it: minimum, block or bounding with none, global, local or manhattan (not those with
// the parameter `cache`, which it lacks).
bool is_of_seed(const StrategyPair& pair);

// One run of a workload. Seconds of the whole of it, without the reading of the script.
struct BenchRun {
  double slowest_rank = 0, quickest_rank = 0;
  double apply = 0, balance = 0, voxelize = 0, exchange = 0, compute = 0, wait = 0;
  double bytes = 0, messages = 0, cache_hits = 0;
  double most_bytes = 0, most_messages = 0;  // of the rank that sent most
  double load_deviation = 0, load_max_over_mean = 1;
  std::string checksum;
};
// From the engine's answer (tasks/workload/run_parallel.h). Throws kEngine for what is not one.
BenchRun run_from(const std::string& result_json);

// All runs of a pair on so many ranks in one benchmark.
struct BenchCell {
  int benchmark = 1;
  int ranks = 1;
  StrategyPair pair;
  std::vector<BenchRun> runs;
  std::vector<BenchRun> apart;  // with Options::phases_apart: for what the phases take

  // Of the runs.
  double median(double BenchRun::*of) const;
  double least(double BenchRun::*of) const;
  double most(double BenchRun::*of) const;
  // Of the runs apart, of the others where there are none.
  double median_apart(double BenchRun::*of) const;
};

struct BenchResult {
  int extracts = 0;  // EXTRACT-ALLs of a run
  int repeats = 0;   // of a run, each with other meshes
  std::vector<BenchCell> cells;
  std::vector<extract::MachineRates> rates;  // of each number of ranks, see MachineRates::ranks

  const BenchCell* find(int benchmark, int ranks, const StrategyPair& pair) const;
  // The fastest on one rank: null where none ran.
  const BenchCell* serial(int benchmark) const;
  const extract::MachineRates* rates_of(int ranks) const;
  // In the order in which they first came.
  std::vector<int> benchmarks() const;
  std::vector<int> ranks() const;
  std::vector<StrategyPair> pairs() const;
};

}  // namespace footwall::tasks
