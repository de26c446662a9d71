#include "storage/formats/opendtect_sticks.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::formats::opendtect_sticks {
namespace {

std::vector<std::size_t> lengths(const SticksImport& read) {
  std::vector<std::size_t> found;
  for (const Stick& stick : read.sticks) found.push_back(stick.points.size());
  return found;
}

TEST(OpendtectSticks, ReadsTheSingleFormWithAndWithoutIndices) {
  const SticksImport indexed =
      parse("605000.5\t6075000\t1.2\t0\t0\n605010\t6075010\t1.3\t0\t1\n605020\t6075000\t1.2\t1\t0\n");
  EXPECT_EQ(lengths(indexed), (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(indexed.sticks[0].points[0], (survey::WorldPoint{605000.5, 6075000, 1.2}));
  const SticksImport on_a_line = parse("1\t2\t3\t0\t0\tLine 7\n1\t2\t4\t0\t1\tLine 7\n");
  EXPECT_EQ(lengths(on_a_line), (std::vector<std::size_t>{2}));
  EXPECT_EQ(lengths(parse("1\t2\t3\n1\t2\t4\n")), (std::vector<std::size_t>{2}));
}

TEST(OpendtectSticks, ReadsTheBulkForm) {
  const std::string text =
      "\"Fault A\"\t1\t2\t3\t0\t0\r\n\"Fault A\"\t1\t2\t4\t0\t1\r\n\"B\"\t1\t2\t5\t0\t0\r\n";
  EXPECT_TRUE(recognises_bulk(text));
  EXPECT_FALSE(recognises(text));
  const SticksImport read = parse(text);
  ASSERT_EQ(read.sticks.size(), 2U);
  EXPECT_EQ(read.sticks[0].fault, "Fault A");
  EXPECT_EQ(read.sticks[1].fault, "B");
  EXPECT_EQ(parse("\"Fault A\" 1 2 3 0\n").sticks[0].fault, "Fault A");
}

TEST(OpendtectSticks, AColumnThatStartsAgainCountsNodes) {
  const SticksImport read = parse("1\t2\t3\t0\n1\t2\t4\t1\n1\t2\t5\t2\n9\t2\t3\t0\n9\t2\t4\t1\n");
  EXPECT_EQ(lengths(read), (std::vector<std::size_t>{3, 2}));
  EXPECT_NE(read.report.assumed.front().find("counts nodes"), std::string::npos);
  // Sticks of one node: nothing starts again, also not at the next fault.
  EXPECT_EQ(lengths(parse("1\t2\t3\t0\n1\t2\t4\t1\n1\t2\t5\t2\n")), (std::vector<std::size_t>{1, 1, 1}));
  EXPECT_EQ(
      parse("\"A\"\t1\t2\t3\t0\n\"A\"\t1\t2\t4\t1\n\"B\"\t1\t2\t3\t0\n\"B\"\t1\t2\t4\t1\n").sticks.size(),
      4U);
}

TEST(OpendtectSticks, RejectsBadRowsWithTheirPlace) {
  const SticksImport read =
      parse("\"A\"\t1\t2\t3\t0\t0\n\"A\"\t1\t?\t3\t0\t0\n\"A\"\t1\t2\n\"A\"\t1\t2\t4\t0\t1\n");
  EXPECT_EQ(read.report.read, 2);
  ASSERT_EQ(read.report.rejected_count, 2);
  EXPECT_EQ(read.report.rejected[0].line, 2);
  EXPECT_EQ(read.report.rejected[0].column, 7);
  EXPECT_THROW(parse("nothing\n"), Error);
}

TEST(OpendtectSticks, WritesNamesThatItsQuotesCanHold) {
  std::vector<std::string> renamed;
  const std::vector<Stick> sticks{{"a \"b\"", 1, {{1, 2, 3}}}};
  EXPECT_EQ(write_bulk(sticks, {}, renamed), "\"a _b_\"\t1.0000\t2.0000\t3.0000\t0\t0\n");
  EXPECT_EQ(renamed.size(), 1U);
}

}  // namespace
}  // namespace footwall::formats::opendtect_sticks
