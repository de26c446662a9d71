#include "engine/tasks/bench_extract/published.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

double smallest(int benchmark) {
  double least = 1e9;
  for (const PublishedRow& row : published_seconds(benchmark)) {
    for (const double value : row.values) {
      if (value > 0) least = std::min(least, value);
    }
  }
  return least;
}

// The best of any strategy, and the serial run, as the text names them.
TEST(Published, TheBestFiguresAreThose) {
  EXPECT_EQ(smallest(1), 1.00);
  EXPECT_EQ(smallest(2), 3.56);
  EXPECT_EQ(smallest(3), 18.46);
  EXPECT_EQ(published_serial_seconds(1), 36.39);
  EXPECT_EQ(published_serial_seconds(2), 86.99);
  EXPECT_EQ(published_serial_seconds(3), 133.57);
}

TEST(Published, EveryStrategyMeetsEveryBalancer) {
  for (const int benchmark : {1, 2, 3}) {
    for (const char* exchange : {"minimum", "block=2", "bounding"}) {
      for (const char* balance : {"none", "global=0", "local=0", "manhattan=0", "manhattan=0,2"}) {
        const auto rows = published_seconds(benchmark);
        EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                                [&](const PublishedRow& row) {
                                  return row.exchange == exchange && row.balance == balance;
                                }),
                  1)
            << benchmark << exchange << balance;
      }
    }
  }
  EXPECT_EQ(published_deviations().size(), 5U);
}

// Speedups of the text's tables that are no misprints, from the seconds of the appendix.
TEST(Published, SecondsGiveTheSpeedupsOfTheText) {
  const auto speedup = [](int benchmark, const std::string& name, int ranks) {
    for (const PublishedRow& row : published_seconds(benchmark)) {
      if (row.name == name) return published_serial_seconds(benchmark) / *published_value(row, ranks);
    }
    return 0.0;
  };
  EXPECT_NEAR(speedup(1, "MC-localb", 256), 36.39, 0.01);
  EXPECT_NEAR(speedup(1, "MC-nolb", 2), 0.83, 0.005);  // printed as 0.33
  EXPECT_NEAR(speedup(2, "BV-mhlb-2", 256), 2.94, 0.005);
  EXPECT_NEAR(speedup(3, "BT-mhlb-2", 16), 0.87, 0.005);
  EXPECT_NEAR(speedup(3, "MC-globalb", 32), 3.56, 0.005);
}

TEST(Published, OtherRanksHaveNoFigure) {
  EXPECT_EQ(published_value(published_seconds(1).front(), 3), nullptr);
  EXPECT_EQ(published_value(published_seconds(1).front(), 1), nullptr);
  EXPECT_THROW(published_seconds(4), Error);
  EXPECT_THROW(published_serial_seconds(0), Error);
}

}  // namespace
}  // namespace footwall::tasks
