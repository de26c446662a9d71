#include "engine/tasks/bench_extract/tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_up.h"

namespace footwall::tasks {
namespace {

std::string word(const Table& table, const std::string& row, std::size_t column) {
  for (const auto& words : table.rows) {
    if (words.front() == row) return words.at(column);
  }
  return "no row " + row;
}

TEST(Tables, HaveTheSeedsFiguresBeside) {
  const std::vector<Table> tables = benchmark_tables(made_up());
  ASSERT_EQ(tables.size(), 5U);
  // Medians of the runs; the seed's on 2 CPUs; none of its on one rank but the serial run's.
  EXPECT_EQ(word(tables[0], "minimum, none", 1), "MC-nolb");
  EXPECT_EQ(word(tables[0], "minimum, none", 2), "9.0000");
  EXPECT_EQ(word(tables[0], "minimum, none", 3), "4.5000 [122.20]");
  EXPECT_EQ(word(tables[0], "push, none", 3), "3.0000");
  EXPECT_EQ(word(tables[0], "best serial run: auto, auto", 2), "6.0000 [86.99]");
  // Over the best serial run, 6 s.
  EXPECT_EQ(word(tables[1], "minimum, none", 3), "1.33 (0.67) [0.71]");
  EXPECT_EQ(word(tables[2], "minimum, none", 3), "2.2500 / 1.1250 (22)");
  EXPECT_EQ(word(tables[4], "none", 2), "1234 [4035741]");
  EXPECT_EQ(word(tables[4], "auto", 2), "1234");
}

TEST(Tables, WithoutASerialRunThereIsNoSpeedup) {
  BenchResult result = made_up();
  std::erase_if(result.cells, [](const BenchCell& cell) { return cell.ranks == 1; });
  for (const Table& table : benchmark_tables(result))
    EXPECT_EQ(table.title.find("speedup"), std::string::npos) << table.title;
}

}  // namespace
}  // namespace footwall::tasks
