// footwall bench extract: the seed's benchmarks 1 to 3 over strategies, balancers and ranks.
// Based on: seed 004, section 5.2.1: 16 random meshes, 5 move-extract cycles x 2 repeats, the voxels' cache
// kept from cycle to cycle; differs in that every strategy must give the same results, to the bit, before a
// time counts.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/session/launch.h"
#include "engine/tasks/bench_extract/results.h"
#include "engine/tasks/workload/make.h"
#include "engine/tasks/workload/run.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct BenchExtractOptions {
  std::vector<int> benchmarks{1, 2, 3};
  std::vector<int> ranks{1, 2, 4, 8};
  std::vector<std::string> exchanges;  // empty: bench_exchanges()
  std::vector<std::string> balances;   // empty: bench_balances()
  std::vector<std::string> compute{"variance"};
  double snr = 40;   // dB, where `lot` is computed
  int repeat = 1;    // runs of each cell; the median counts
  int apart = 1;     // of them, on several ranks, are repeated with their phases apart
  double scale = 1;  // of the numbers of faces and cycles, for trials: 0..1
  session::LaunchOptions launch;
};

// minimum, block=2, bounding, push, reduce; none, global=0, local=0, manhattan=0, manhattan=0,2, minimal.
std::vector<std::string> bench_exchanges();
std::vector<std::string> bench_balances();

// What is run on a number of ranks: every exchange with every balancer that can compute what is asked, and
// auto with auto. On one rank balancers have nothing to do: there each exchange runs with `none`.
std::vector<StrategyPair> pairs_for(const BenchExtractOptions& options, int ranks);
// The workload of a benchmark.
WorkloadShape shape_of_benchmark(int benchmark, double scale);

// How a workload is run and a machine is measured: the engine, or a test's own.
struct BenchEngine {
  std::function<std::string(const WorkloadRunOptions& options, const JobContext& job)> run;
  std::function<extract::MachineRates(int ranks, const JobContext& job)> rates;
};
BenchEngine real_engine(const session::LaunchOptions& launch);

// Runs go round over the pairs, so that what slows the machine for a while slows all alike. Throws kUsage for
// options that cannot be; kInternal where two runs of a benchmark do not give the same results; what the
// engine throws; kCancelled.
BenchResult bench_extract(const BenchExtractOptions& options, const BenchEngine& engine,
                          const JobContext& job);

}  // namespace footwall::tasks
