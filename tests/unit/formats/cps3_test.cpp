#include "storage/formats/cps3.h"

#include <gtest/gtest.h>

#include "damaged_text.h"

namespace footwall::formats::cps3 {
namespace {

const std::string kFile =
    "! made by hand\n"
    "FFASCI 0 1 -999.25\n"
    "FFATTR 0 2\n"
    "->\r\n"
    "1601885.25 -178006.5 1500\r\n"
    "1602435.2\t-178182.5 1510 7\r\n"
    "1602435.2 -178182.5 -999.25\r\n"
    "1602435.2 -178182.5 1.0E+30\r\n"
    "1602435.2 -178182.5\r\n"
    "-> 2\n"
    "1601885.25 -178006.5 1500\n"
    "->Big fault\n"
    "1 2 3\n";

TEST(Cps3, ArrowsPartLines) {
  EXPECT_TRUE(recognises(kFile));
  SticksOptions options;
  options.fault = std::string("F");
  const SticksImport read = parse(kFile, options);
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "F");
  EXPECT_EQ(read.sticks[0].points,
            (std::vector<survey::WorldPoint>{{1601885.25, -178006.5, 1500}, {1602435.2, -178182.5, 1510}}));
  EXPECT_EQ(read.sticks[1].points.size(), 1u);
  EXPECT_EQ(read.sticks[2].fault, "Big fault");
  ASSERT_EQ(read.report.rejected_count, 3);
  EXPECT_NE(read.report.rejected[0].reason.find("file's null"), std::string::npos);
  EXPECT_EQ(read.report.rejected[0].line, 7);
  EXPECT_EQ(read.report.rejected[0].column, 21);
  EXPECT_NE(read.report.rejected[2].reason.find("ends before the z"), std::string::npos);
  EXPECT_TRUE(says(read.report.assumed, "names the fault"));
}

TEST(Cps3, AWholeNumberAtTheHeadersEndIsNoNull) {
  EXPECT_EQ(parse("FFASCI 0 1 2 3\n-> 1\n1 2 3\n").report.rejected_count, 0);
}

TEST(Cps3, GridsAreRefusedByName) {
  const std::string grid = "FSASCI 0 1 0 5 1.0E+30\nFSLIMI 100 110 200 220 0 6\nFSNROW 3 2\n->\n1 2\n3 4\n";
  EXPECT_FALSE(recognises(grid));
  try {
    parse(grid);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("CPS-3 grid"), std::string::npos);
  }
  EXPECT_THROW(parse("->\n1 2\n"), Error);
}

TEST(Cps3, WhatIsWrittenIsReadBackTheSame) {
  for (const bool up : {false, true}) {
    SticksWriteOptions options;
    options.z_positive_up = up;
    std::vector<std::string> renamed;
    const std::string text = write(sample_sticks(true), options, renamed);
    EXPECT_TRUE(recognises(text));
    SticksOptions in;
    in.z_positive_up = up;
    in.fault = std::string("Big fault 1");
    expect_same_sticks(sample_sticks(true), parse(text, in).sticks);
  }
}

TEST(Cps3, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kFile.substr(kFile.find("->")),
                            [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::cps3
