#include "engine/tasks/bench_extract/bench_extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/extract/registry.h"
#include "engine/session/private_folder.h"
#include "engine/session/self_check.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr double kArea = 1000;  // voxel^2
constexpr double kFaces1 = 5000;
constexpr double kFaces2 = 10000;
constexpr double kFaces3 = 15000;
constexpr double kCycles = 5;
constexpr std::int64_t kRepeats = 2;
constexpr double kDistance = 10;  // voxels

void check(const BenchExtractOptions& options) {
  if (options.benchmarks.empty() || options.ranks.empty())
    throw Error(ErrorCode::kUsage, "there is nothing to run",
                "name at least one benchmark and one number of ranks");
  for (const int benchmark : options.benchmarks) {
    if (benchmark < 1 || benchmark > 3) {
      throw Error(ErrorCode::kUsage, fmt::format("there is no benchmark {}", benchmark), "give 1, 2 or 3");
    }
  }
  for (const int ranks : options.ranks) {
    if (ranks < 1)
      throw Error(ErrorCode::kUsage, fmt::format("there cannot be {} ranks", ranks), "give 1 or more");
  }
  if (options.repeat < 1)
    throw Error(ErrorCode::kUsage, fmt::format("--repeat {} gives no median", options.repeat),
                "give 1 or more");
  if (options.apart < 0)
    throw Error(ErrorCode::kUsage, fmt::format("there cannot be {} runs apart", options.apart),
                "give 0 or more");
  if (!(options.scale > 0 && options.scale <= 1)) {
    throw Error(ErrorCode::kUsage, fmt::format("--scale {} cannot be", options.scale),
                "give a number above 0, at most 1, such as 0.1 for a trial");
  }
}

extract::Options options_for(const BenchExtractOptions& options, const StrategyPair& pair) {
  extract::Options engine;
  engine.exchange = pair.exchange;
  engine.balance = pair.balance;
  engine.compute = options.compute;
  const auto& names = options.compute;
  if (std::find(names.begin(), names.end(), "lot") != names.end()) engine.snr = options.snr;
  return engine;
}

// Whether the pair can compute what is asked. A name that is wrong in any case is told by the first run.
bool can_compute(const BenchExtractOptions& options, const StrategyPair& pair) {
  const std::string name = pair.exchange.substr(0, pair.exchange.find('='));
  if (name != "reduce") return true;
  try {
    extract::validate(options_for(options, pair));
    return true;
  } catch (const Error&) {
    return false;
  }
}

struct Bench {
  const BenchExtractOptions& options;
  const BenchEngine& engine;
  const JobContext& job;
  BenchResult result;
  std::size_t done = 0, all = 0;

  void run(int benchmark, const std::filesystem::path& script) {
    std::optional<std::string> first;  // checksum
    std::string whose;
    for (int round = 0; round < options.repeat; ++round) {
      for (const int ranks : options.ranks) {
        for (const StrategyPair& pair : pairs_for(options, ranks)) {
          const double share = 1 / static_cast<double>(all);
          const auto at = static_cast<double>(done++);
          job.report(at * share, "bench",
                     fmt::format("benchmark {}, {} on {} ranks, run {}", benchmark, name_of(pair), ranks,
                                 round + 1));
          WorkloadRunOptions how;
          how.script = script;
          how.launch = options.launch;
          how.launch.ranks = ranks;
          how.options = options_for(options, pair);
          const JobContext part = job.part(at * share, (at + 1) * share);
          const std::string me = fmt::format("{} on {} ranks", name_of(pair), ranks);
          const auto checked_run = [&] {
            BenchRun one = run_from(engine.run(how, part));
            if (first && *first != one.checksum) {
              throw Error(ErrorCode::kInternal,
                          fmt::format("benchmark {}: {} gives other results than {}", benchmark, me, whose),
                          "no time was counted; please report it");
            }
            if (!first) whose = me;
            first = one.checksum;
            return one;
          };
          cell(benchmark, ranks, pair).runs.push_back(checked_run());
          if (ranks == 1 || round >= options.apart) continue;
          how.options.phases_apart = true;
          cell(benchmark, ranks, pair).apart.push_back(checked_run());
        }
      }
    }
  }

  BenchCell& cell(int benchmark, int ranks, const StrategyPair& pair) {
    for (BenchCell& each : result.cells) {
      if (each.benchmark == benchmark && each.ranks == ranks && each.pair == pair) return each;
    }
    return result.cells.emplace_back(BenchCell{benchmark, ranks, pair, {}, {}});
  }
};

}  // namespace

std::vector<std::string> bench_exchanges() {
  return {"minimum", "block=2", "bounding", "push", "reduce"};
}
std::vector<std::string> bench_balances() {
  return {"none", "global=0", "local=0", "manhattan=0", "manhattan=0,2", "minimal"};
}

std::vector<StrategyPair> pairs_for(const BenchExtractOptions& options, int ranks) {
  const auto exchanges = options.exchanges.empty() ? bench_exchanges() : options.exchanges;
  const auto balances = options.balances.empty() ? bench_balances() : options.balances;
  std::vector<StrategyPair> pairs;
  const auto add = [&](const StrategyPair& pair) {
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end() && can_compute(options, pair))
      pairs.push_back(pair);
  };
  for (const std::string& exchange : exchanges) {
    if (exchange == "auto") continue;
    for (const std::string& balance : balances) {
      if (balance != "auto") add({exchange, ranks == 1 ? "none" : balance});
    }
  }
  add({"auto", "auto"});
  return pairs;
}

WorkloadShape shape_of_benchmark(int benchmark, double scale) {
  WorkloadShape shape;
  shape.size = benchmark == 1   ? survey::Index{100, 100, 50}
               : benchmark == 2 ? survey::Index{200, 200, 100}
                                : survey::Index{400, 400, 200};
  const double faces = benchmark == 1 ? kFaces1 : benchmark == 2 ? kFaces2 : kFaces3;
  shape.area = kArea;
  // A mesh has one face when it is made; those count.
  shape.faces = std::max<std::int64_t>(1, std::llround(faces * scale) - shape.meshes);
  shape.cycles = std::max<std::int64_t>(2, std::llround(kCycles * scale));
  shape.distance = kDistance;
  shape.repeats = kRepeats;
  return shape;
}

BenchEngine real_engine(const session::LaunchOptions& launch) {
  return {run_workload_engine, [launch](int ranks, const JobContext& job) {
            session::LaunchOptions options = launch;
            options.ranks = ranks;
            options.threads = 1;
            const session::PrivateFolder folder(session::temporary_home());
            const auto rates = session::check_engine(options, folder.path(), job).rates;
            if (!rates) throw Error(ErrorCode::kEngine, "the engine did not measure the machine");
            return *rates;
          }};
}

BenchResult bench_extract(const BenchExtractOptions& options, const BenchEngine& engine,
                          const JobContext& job) {
  check(options);
  Bench bench{options, engine, job, {}};
  for (const int ranks : options.ranks) {
    for (const StrategyPair& pair : pairs_for(options, ranks)) extract::validate(options_for(options, pair));
    bench.all += pairs_for(options, ranks).size() * options.benchmarks.size() *
                 static_cast<std::size_t>(options.repeat);
  }
  // Before the runs, so that these find them in the cache and do not measure while they are timed.
  for (const int ranks : options.ranks) {
    if (ranks > 1) bench.result.rates.push_back(engine.rates(ranks, job.part(0, 0)));
  }
  const session::PrivateFolder folder(session::temporary_home());
  for (const int benchmark : options.benchmarks) {
    const std::filesystem::path script = folder.path() / fmt::format("benchmark-{}", benchmark);
    const WorkloadShape shape = shape_of_benchmark(benchmark, options.scale);
    make_workload(shape, script, job.part(0, 0));
    bench.result.extracts = static_cast<int>(shape.cycles * shape.repeats);
    bench.result.repeats = static_cast<int>(shape.repeats);
    bench.run(benchmark, script);
  }
  return std::move(bench.result);
}

}  // namespace footwall::tasks
