// Results for the tests of this folder.
#pragma once
#include "engine/tasks/bench_extract/results.h"

namespace footwall::tasks {

inline BenchRun run_of(double seconds, double exchange = 1) {
  BenchRun run;
  run.slowest_rank = seconds;
  run.quickest_rank = seconds / 2;
  run.exchange = exchange;
  run.bytes = 4e6;
  run.messages = 100;
  run.most_bytes = 3e6;
  run.most_messages = 60;
  run.load_deviation = 1234;
  run.checksum = "0123456789abcdef";
  return run;
}

// Benchmark 2 on 1 and 2 ranks.
inline BenchResult made_up() {
  BenchResult result;
  result.extracts = 10;
  result.repeats = 2;
  result.cells = {{2, 1, {"minimum", "none"}, {run_of(9), run_of(8), run_of(30)}, {}},
                  {2, 1, {"auto", "auto"}, {run_of(6)}, {}},
                  {2, 2, {"minimum", "none"}, {run_of(5, 1.5), run_of(4, 2), run_of(4.5, 2.5)}, {}},
                  {2, 2, {"block=2", "local=0"}, {run_of(4, 3)}, {run_of(4, 2)}},
                  {2, 2, {"push", "none"}, {run_of(3)}, {}},
                  {2, 2, {"minimum", "local=0,cache"}, {run_of(1)}, {}},
                  {2, 2, {"auto", "auto"}, {run_of(3.2, 0.5)}, {}}};
  extract::MachineRates rates;
  rates.ranks = 2;
  rates.byte = 1e-7;
  rates.alpha = 1e-3;
  rates.voxelize = rates.fold = rates.gather = rates.pack = 1e-9;
  result.rates = {rates};
  return result;
}

}  // namespace footwall::tasks
