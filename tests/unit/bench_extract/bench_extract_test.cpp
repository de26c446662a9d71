#include "engine/tasks/bench_extract/bench_extract.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

std::string answer(double seconds, const std::string& checksum) {
  return nlohmann::json{{"slowest_rank", seconds},
                        {"quickest_rank", seconds},
                        {"seconds",
                         {{"apply", 0.1},
                          {"balance", 0.1},
                          {"voxelize", 0.1},
                          {"exchange", 0.1},
                          {"compute", 0.1},
                          {"wait", 0}}},
                        {"bytes_sent", 1},
                        {"messages", 1},
                        {"most_bytes_sent", 1},
                        {"most_messages", 1},
                        {"cache_hits", 0},
                        {"load_deviation", 0},
                        {"load_max_over_mean", 1},
                        {"checksum", checksum}}
      .dump();
}

// An engine that remembers what it was asked.
struct Fake {
  std::vector<WorkloadRunOptions> asked;
  std::string odd_exchange;  // gives other results
  BenchEngine engine() {
    return {[this](const WorkloadRunOptions& options, const JobContext&) {
              EXPECT_TRUE(std::filesystem::exists(options.script));
              asked.push_back(options);
              return answer(1, options.options.exchange == odd_exchange ? "b" : "a");
            },
            [](int ranks, const JobContext&) {
              extract::MachineRates rates;
              rates.ranks = ranks;
              return rates;
            }};
  }
};

BenchExtractOptions small() {
  BenchExtractOptions options;
  options.benchmarks = {1};
  options.ranks = {1, 2};
  options.scale = 0.01;
  options.repeat = 2;
  return options;
}

TEST(BenchExtract, RunsEveryPairAndAutoOnEveryNumberOfRanks) {
  Fake fake;
  BenchExtractOptions options = small();
  options.exchanges = {"minimum", "reduce"};
  options.balances = {"none", "global=0"};
  const BenchResult result = bench_extract(options, fake.engine(), {});
  // One rank: 2 exchanges and auto; two ranks: 4 pairs and auto; twice each, and those on two ranks once more
  // with their phases apart.
  EXPECT_EQ(fake.asked.size(), 2U * (3 + 5) + 5);
  EXPECT_EQ(std::count_if(fake.asked.begin(), fake.asked.end(),
                          [](const WorkloadRunOptions& run) { return run.options.phases_apart; }),
            5);
  EXPECT_EQ(result.cells.size(), 8U);
  for (const BenchCell& cell : result.cells) {
    EXPECT_EQ(cell.runs.size(), 2U);
    EXPECT_EQ(cell.apart.size(), cell.ranks == 1 ? 0U : 1U);
  }
  EXPECT_NE(result.find(1, 2, {"auto", "auto"}), nullptr);
  EXPECT_EQ(result.find(1, 1, {"minimum", "global=0"}), nullptr);
  ASSERT_EQ(result.rates.size(), 1U);
  EXPECT_EQ(result.rates[0].ranks, 2);
  EXPECT_EQ(fake.asked[0].options.compute, std::vector<std::string>{"variance"});
  EXPECT_EQ(fake.asked[0].launch.ranks, 1);
}

TEST(BenchExtract, CountsNoTimeWhereResultsDiffer) {
  Fake fake;
  fake.odd_exchange = "push";
  BenchExtractOptions options = small();
  options.exchanges = {"minimum", "push"};
  options.balances = {"none"};
  try {
    bench_extract(options, fake.engine(), {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("push, none on 1 ranks gives other results"), std::string::npos)
        << error.message();
  }
}

TEST(BenchExtract, RunsWithPhasesApartMustGiveTheSame) {
  BenchEngine engine;
  engine.run = [](const WorkloadRunOptions& options, const JobContext&) {
    return answer(1, options.options.phases_apart ? "b" : "a");
  };
  engine.rates = [](int, const JobContext&) { return extract::MachineRates{}; };
  EXPECT_THROW(bench_extract(small(), engine, {}), Error);
}

TEST(BenchExtract, TheWorkloadsAreTheSeeds) {
  const WorkloadShape shape = shape_of_benchmark(2, 1);
  EXPECT_EQ(shape.size, (survey::Index{200, 200, 100}));
  EXPECT_EQ(shape.faces + shape.meshes, 10000);
  EXPECT_EQ(shape.area, 1000);
  EXPECT_EQ(shape.cycles, 5);
  EXPECT_EQ(shape.repeats, 2);
  EXPECT_EQ(shape.distance, 10);
  EXPECT_EQ(shape_of_benchmark(3, 1).size, (survey::Index{400, 400, 200}));
  EXPECT_EQ(shape_of_benchmark(1, 0.1).faces + shape.meshes, 500);
}

TEST(BenchExtract, RefusesWhatCannotBe) {
  Fake fake;
  for (int n = 0; n < 7; ++n) {
    BenchExtractOptions options = small();
    if (n == 0) options.benchmarks = {4};
    if (n == 1) options.ranks = {};
    if (n == 2) options.repeat = 0;
    if (n == 3) options.scale = 0;
    if (n == 4) options.exchanges = {"pigeon"};
    if (n == 5) options.compute = {"horoscope"};
    if (n == 6) options.apart = -1;
    try {
      bench_extract(options, fake.engine(), {});
      FAIL() << n;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage) << n;
    }
  }
  EXPECT_TRUE(fake.asked.empty());
}

}  // namespace
}  // namespace footwall::tasks
