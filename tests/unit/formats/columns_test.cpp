#include "storage/formats/columns.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::formats::columns {
namespace {

SticksOptions mapped(const std::string& columns, int header_rows = 0, char delimiter = 0) {
  SticksOptions options;
  options.columns = map_from(columns);
  options.columns->header_rows = header_rows;
  options.columns->delimiter = delimiter;
  return options;
}

TEST(Columns, AreNamedByTheUser) {
  const ColumnMap map = map_from("name=6,x=3, y=4,z=5,stick=7,node=8,inline=1,crossline=2");
  EXPECT_EQ(map.name, 6);
  EXPECT_EQ(map.y, 4);
  EXPECT_EQ(map.crossline_number, 2);
  for (const char* bad :
       {"", "x=1,y=2", "x=1,z=3", "inline=1,z=3", "x=0,y=2,z=3", "x=1,y=2,z=3,z=4", "x=1,y=2,z=3,w=4",
        "x=1,y=2,z", "x=1,y=2,z=3.5", "x=1,y=2,z=99999", "x=1,y=2,z=3,"}) {
    EXPECT_THROW(map_from(bad), Error) << bad;
  }
  EXPECT_NO_THROW(map_from("inline=1,crossline=2,z=3"));
  EXPECT_EQ(delimiter_from("tab"), '\t');
  EXPECT_EQ(delimiter_from("|"), '|');
  for (const char* bad : {"", "a", "7", "||", "\n"}) EXPECT_THROW(delimiter_from(bad), Error);
}

TEST(Columns, ReadAnyOrderAndDelimiter) {
  const SticksImport read = parse("made by hand\nname|z|x|y|s\nF 1 | 3 | 1 | 2 | 7\nF 1|4|1|2|7\n|5|1|2|8\n",
                                  mapped("name=1,z=2,x=3,y=4,stick=5", 2, '|'));
  ASSERT_EQ(read.sticks.size(), 2U);
  EXPECT_EQ(read.sticks[0].fault, "F 1");
  EXPECT_EQ(read.sticks[0].points[1], (survey::WorldPoint{1, 2, 4}));
  EXPECT_EQ(read.sticks[1].fault, "unnamed");
  EXPECT_EQ(read.report.skipped, 2);

  // Kingdom's, split on blanks: two words of marks, X and Y at 6 and 7.
  const SticksImport kingdom =
      parse("INLINE- 0 0 a b 500.5 600.5 c 70 \"F 2\" 3 x\n", mapped("x=6,y=7,z=9,name=10,stick=11"));
  EXPECT_EQ(kingdom.sticks[0].fault, "F 2");
  EXPECT_EQ(kingdom.sticks[0].points[0], (survey::WorldPoint{500.5, 600.5, 70}));
}

TEST(Columns, HeadingsNameThemWhereTheUserDoesNot) {
  const std::string text = "# c\nFault_Name,Inline,Stick,X,Y,Depth\nA,7,1,10,20,30\nA,7,1,10,20,31\n";
  EXPECT_TRUE(recognises(text));
  const SticksImport read = parse(text);
  EXPECT_EQ(read.sticks[0].fault, "A");
  EXPECT_EQ(read.sticks[0].points[1], (survey::WorldPoint{10, 20, 31}));
  EXPECT_EQ(read.report.assumed.front(), "columns by their headings: name=1,stick=3,x=4,y=5,z=6,inline=2");
  EXPECT_FALSE(recognises("X,Y,Z\n"));
  EXPECT_FALSE(recognises("A,B,C\n1,2,3\n"));
  EXPECT_FALSE(recognises("X,Y,Z\na,b,c\n"));
  EXPECT_THROW(parse("A,B,C\n1,2,3\n"), Error);
}

TEST(Columns, NodesThatDoNotRiseAndBlankLinesPartSticks) {
  EXPECT_EQ(parse("1 2 3 1\n1 2 4 2\n1 2 5 1\n", mapped("x=1,y=2,z=3,node=4")).sticks.size(), 2U);
  EXPECT_EQ(parse("1 2 3\n\n1 2 4\n", mapped("x=1,y=2,z=3")).sticks.size(), 2U);
}

TEST(Columns, LinesStandInForXAndY) {
  SticksOptions options = mapped("inline=1,crossline=2,z=3,x=4,y=5,stick=6", 0, ',');
  survey::Geometry g;
  g.inlines = {100, 2, 50};
  g.crosslines = {300, 1, 60};
  g.map = {1000, 2000, 20, 0, 0, 25};
  options.survey = g;
  const SticksImport read = parse("104,310,8,,,1\n,,9,5,6,1\n,,9,5,,1\n,,9,,,1\n", options);
  ASSERT_EQ(read.report.read, 2);
  EXPECT_EQ(read.sticks[0].points[0], (survey::WorldPoint{1040, 2250, 8}));
  EXPECT_EQ(read.sticks[0].points[1], (survey::WorldPoint{5, 6, 9}));
  ASSERT_EQ(read.report.rejected_count, 2);
  EXPECT_EQ(read.report.rejected[0].reason, "the Y coordinate is missing");
  EXPECT_TRUE(parse("104 310 8 1\n", mapped("inline=1,crossline=2,z=3,stick=4")).sticks[0].in_line_numbers);
}

TEST(Columns, RejectsBadRowsWithTheirPlace) {
  const SticksImport read =
      parse("1;2;3;1\n1;2;3\n1;;3;1\n1;2;z;1\n1;2;4;1.5\n1;2;4;1\n", mapped("x=1,y=2,z=3,stick=4"));
  EXPECT_EQ(read.report.read, 2);
  ASSERT_EQ(read.report.rejected_count, 4);
  EXPECT_EQ(read.report.rejected[0].column, 6);
  EXPECT_EQ(read.report.rejected[1].reason, "the Y coordinate is missing");
  EXPECT_EQ(read.report.rejected[2].column, 5);
  EXPECT_EQ(read.report.rejected[3].reason, "'1.5' is no stick number");
}

}  // namespace
}  // namespace footwall::formats::columns
