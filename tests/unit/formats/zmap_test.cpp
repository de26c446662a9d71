#include "storage/formats/zmap.h"

#include <gtest/gtest.h>

#include "damaged_text.h"

namespace footwall::formats::zmap {
namespace {

const std::string kFile =
    "!\r\n"
    "! Polygons/points Z-MAP file\r\n"
    "@FREE POINT        , DATA, 80, 1\r\n"
    "X (EASTING)        , 1, 1,  1,             1, 20,,         1.0E+30,,,       4, 0\r\n"
    "Y (NORTHING)       , 2, 2,  1,            21, 40,,         1.0E+30,,,       4, 0\r\n"
    "QUALITY            , 3, 9,  1,            71, 75,,         1.0E+30,,,       4, 0\r\n"
    "Z VALUE            , 4, 3,  1,            41, 60,,         -99.0,,,       4, 0\r\n"
    "SEG I.D.           , 5, 35, 1,            61, 70,,         1.0E+30,,,       0, 0\r\n"
    "@\r\n"
    "       460442.187500      5933082.500000         1696.099487         0    7     \r\n"
    "       460443.000000      5933134.500000               -99.0         0    7     \r\n"
    "       460443.000000      5933134.500000                             0    7     \r\n"
    "       460443.000000      5933134.500000         1695.254517         0    7     \r\n"
    "12345678901.12345678-1234567890.12345678     1695.2545171234         3    7     \r\n";

TEST(Zmap, FieldsAreReadInTheColumnsStated) {
  EXPECT_TRUE(recognises(kFile));
  const SticksImport read = parse(kFile);
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[0].points, (std::vector<survey::WorldPoint>{{460442.1875, 5933082.5, 1696.099487},
                                                                    {460443, 5933134.5, 1695.254517}}));
  EXPECT_EQ(read.sticks[1].number, 3);
  EXPECT_EQ(read.sticks[1].points[0].y, -1234567890.12345678);
  ASSERT_EQ(read.report.rejected_count, 2);
  EXPECT_EQ(read.report.rejected[0].line, 11);
  EXPECT_EQ(read.report.rejected[0].column, 56);
  EXPECT_NE(read.report.rejected[0].reason.find("file's null"), std::string::npos);
  EXPECT_NE(read.report.rejected[1].reason.find("missing"), std::string::npos);
}

TEST(Zmap, RowsThatDoNotFitAreSplitAtBlanks) {
  const SticksImport read = parse(
      "@FREE POINT, DATA, 80, 1\nX, 1, 1, 1, 1, 20\nY, 2, 2, 1, 21, 40\nZ, 3, 3, 1, 41, 60\n@\n1.5 2 3\n4 5 "
      "6\n");
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[0].points[0], (survey::WorldPoint{1.5, 2, 3}));
  EXPECT_TRUE(says(read.report.assumed, "split at blanks"));
  EXPECT_TRUE(says(read.report.assumed, "are points"));
}

TEST(Zmap, GridsAndFilesWithoutZAreRefused) {
  const std::string grid = "! c\n@name, GRID, 5\n20, 1.0E+30,, 4, 1\n2, 2, 0, 1, 0, 1\n@\n1 2\n";
  EXPECT_FALSE(recognises(grid));
  try {
    parse(grid);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("ZMAP+ grid"), std::string::npos);
  }
  try {
    parse("@FREE POINT, DATA, 80, 1\nX, 1, 1, 1, 1, 20\nY, 2, 2, 1, 21, 40\n@\n1 2\n");
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("no z"), std::string::npos);
  }
  EXPECT_THROW(parse(""), Error);
}

TEST(Zmap, WhatIsWrittenIsReadBackTheSameWithUnitAndDirection) {
  for (const bool up : {false, true}) {
    SticksWriteOptions options;
    options.z_positive_up = up;
    options.vertical_unit = std::string("ms");
    std::vector<std::string> renamed;
    const std::string text = write(sample_sticks(true), options, renamed);
    EXPECT_TRUE(recognises(text));
    SticksOptions in;
    in.fault = std::string("Big fault 1");
    const SticksImport read = parse(text, in);
    expect_same_sticks(sample_sticks(true), read.sticks);
    EXPECT_TRUE(says(read.report.assumed, up ? "up, as the file says" : "down, as the file says"));
    EXPECT_TRUE(says(read.report.assumed, "z is in ms, as the file says"));
  }
}

TEST(Zmap, CoordinatesThatExceedTheirColumnsAreNotWritten) {
  std::vector<std::string> renamed;
  EXPECT_THROW(write(std::vector<Stick>{{"F", 1, {{1e15, 0, 0}}}}, {}, renamed), Error);
}

TEST(Zmap, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kFile, [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::zmap
