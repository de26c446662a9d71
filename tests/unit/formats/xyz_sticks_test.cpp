#include "storage/formats/xyz_sticks.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::formats::xyz_sticks {
namespace {

TEST(XyzSticks, ReadsNumberedRowsOfAnyDelimiter) {
  for (const std::string text :
       {"1 2 3 5\n1 2 4 5\n1 2 5 6\n", "1,2,3,5\n1,2,4,5,extra\n1 , 2 , 5 , 6\n",
        "x;y;z;id\n1;2;3;5\n1;2;4;5\n1;2;5;6\n", "# c\n\n  1\t2\t3\t5\r\n1\t2\t4\t5\r\n\r\n1\t2\t5\t6"}) {
    const SticksImport read = parse(text);
    ASSERT_EQ(read.sticks.size(), 2U) << text;
    EXPECT_EQ(read.sticks[0].points.size(), 2U);
    EXPECT_EQ(read.sticks[1].number, 6);
    EXPECT_EQ(read.sticks[1].points[0], (survey::WorldPoint{1, 2, 5}));
    EXPECT_EQ(read.report.rejected_count, 0);
  }
}

TEST(XyzSticks, BlankLinesPartSticks) {
  const std::string text = "\n1 2 3\n1 2 4\n \t\n\n1 2 5\n\n";
  EXPECT_TRUE(recognises_groups(text));
  const SticksImport read = parse_groups(text);
  ASSERT_EQ(read.sticks.size(), 2U);
  EXPECT_EQ(read.sticks[0].points.size(), 2U);
  EXPECT_EQ(read.sticks[1].points.size(), 1U);
  EXPECT_FALSE(recognises_groups("1 2 3\n1 2 4\n\n"));
  EXPECT_FALSE(recognises_groups("1 2 3 1\n\n1 2 4 2\n"));
}

TEST(XyzSticks, RejectsBadRowsAndGoesOn) {
  const SticksImport read = parse("1 2 3 1\n1 2\n1 2 x 1\n1 2 3 one\n1 2 1e30 1\n1 2 4\n1 2 4 1\n");
  EXPECT_EQ(read.report.read, 2);
  ASSERT_EQ(read.report.rejected_count, 5);
  EXPECT_EQ(read.report.rejected[0].line, 2);
  EXPECT_EQ(read.report.rejected[0].reason, "the row ends before the z");
  EXPECT_EQ(read.report.rejected[1].column, 5);
  EXPECT_EQ(read.report.rejected[2].column, 7);
  EXPECT_NE(read.report.rejected[4].reason.find("ends before the stick number"), std::string::npos);
}

TEST(XyzSticks, RecognisesRowsOfNumbersOnly) {
  EXPECT_TRUE(recognises("1 2 3\n"));
  EXPECT_TRUE(recognises("# c\n1,2,3,4\n"));
  EXPECT_FALSE(recognises("1 2\n"));
  EXPECT_FALSE(recognises("1 2 3 F\n"));
  EXPECT_FALSE(recognises("1 2 3 4 5 6\n"));
  EXPECT_FALSE(recognises("# only\n"));
  EXPECT_THROW(parse(""), Error);
}

}  // namespace
}  // namespace footwall::formats::xyz_sticks
