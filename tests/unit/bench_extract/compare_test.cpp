#include "engine/tasks/bench_extract/compare.h"

#include <gtest/gtest.h>

#include "made_up.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

TEST(Compare, AutoWithTheFastestPairOfTheSeed) {
  const std::vector<AutoAgainstSeed> all = auto_against_seed(made_up());
  ASSERT_EQ(all.size(), 1U);  // not of one rank
  // push is not the seed's, nor is local with its cache.
  EXPECT_EQ(all[0].fastest, (StrategyPair{"block=2", "local=0"}));
  EXPECT_DOUBLE_EQ(all[0].time_ratio, 3.2 / 4);
  EXPECT_DOUBLE_EQ(all[0].exchange_ratio, 2 / 0.5);  // from the run apart
  EXPECT_DOUBLE_EQ(all[0].waiting_exchange_ratio, 3 / 0.5);
}

TEST(Compare, TheModelIsBytesAndMessagesOfTheBusiestRank) {
  const BenchResult result = made_up();
  const auto model = exchange_model(result, *result.find(2, 2, {"minimum", "none"}));
  ASSERT_TRUE(model);
  EXPECT_NEAR(*model, 3e6 * 1e-7 + 60 * 1e-3, 1e-12);
  EXPECT_FALSE(exchange_model(result, *result.find(2, 1, {"minimum", "none"})));
  const std::vector<Table> tables = comparison_tables(result);
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[1].rows.size(), 2U);
  EXPECT_EQ(tables[1].rows[0].back(), "5.56");  // 2 s measured over 0.36
}

TEST(Compare, SeedPairs) {
  EXPECT_TRUE(is_of_seed({"block=4", "manhattan=5,2"}));
  EXPECT_FALSE(is_of_seed({"push", "none"}));
  EXPECT_FALSE(is_of_seed({"minimum", "minimal"}));
  EXPECT_FALSE(is_of_seed({"minimum", "local=0,cache"}));
  EXPECT_FALSE(is_of_seed({"auto", "auto"}));
}

TEST(Results, MediansAreOfTheRuns) {
  const BenchResult result = made_up();
  const BenchCell& cell = *result.find(2, 1, {"minimum", "none"});
  EXPECT_EQ(cell.median(&BenchRun::slowest_rank), 9);
  EXPECT_EQ(cell.least(&BenchRun::slowest_rank), 8);
  EXPECT_EQ(cell.most(&BenchRun::slowest_rank), 30);
  EXPECT_THROW(run_from("{}"), Error);
  EXPECT_THROW(run_from("no"), Error);
}

}  // namespace
}  // namespace footwall::tasks
