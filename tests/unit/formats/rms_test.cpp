#include "storage/formats/rms.h"

#include <gtest/gtest.h>

#include "damaged_text.h"

namespace footwall::formats::rms {
namespace {

const std::string kLines =
    "999.000000 999.000000 999.000000\r\n"
    "\r\n"
    "494121.915283 6735844.832520 2955.066406\r\n"
    "493463.301758 6734211.470459 999.000000\r\n"
    "\r\n"
    "999.0 6734211.470459 2990\r\n"
    "999.00 999.00 999.00\r\n"
    "999.000000 999.000000 999.000000\r\n"
    "495557.068726 6728723.543701 3635.904785\r\n";

TEST(Rms, OnlyThreeTimesTheMarkEndsALine) {
  EXPECT_TRUE(recognises(kLines));
  SticksOptions options;
  options.fault = std::string("Top Reek");
  const SticksImport read = parse(kLines, options);
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[0].fault, "Top Reek");
  ASSERT_EQ(read.sticks[0].points.size(), 3u);
  EXPECT_EQ(read.sticks[0].points[1].z, 999.0);
  EXPECT_EQ(read.sticks[0].points[2].x, 999.0);
  EXPECT_EQ(read.sticks[1].number, 2);
  EXPECT_TRUE(says(read.report.assumed, "z is positive down"));
}

TEST(Rms, WithoutTheMarkRowsArePoints) {
  const SticksImport read = parse("1 2 3\n4 5 6\n7 8 9\n");
  EXPECT_EQ(read.sticks.size(), 3u);
  EXPECT_TRUE(says(read.report.assumed, "are points"));
  EXPECT_FALSE(recognises("1 2 3\n4 5 6\n"));
}

TEST(Rms, AttributesMayNameFaultAndStick) {
  const std::string text =
      "String  Fault_Name\nInt Seg\nFloat MyNum\n"
      "461288.81 5933414.92 1640.40 OP_4 1 1.0\n"
      "462749.33 5932898.50 1603.03 OP_4 1 UNDEF\n"
      "462698.16 5934227.79 1599.42 'Main fault' 3 22.0\n"
      "464009.15 5931756.39 1629.98 OP_4 UNDEF 1.0\n"
      "464009.15 5931756.39 UNDEF OP_4 1 1.0\n"
      "464009.15 5931756.39\n";
  EXPECT_TRUE(recognises(text));
  const SticksImport read = parse(text);
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[0].fault, "OP_4");
  EXPECT_EQ(read.sticks[0].points.size(), 2u);
  EXPECT_EQ(read.sticks[1].fault, "Main fault");
  EXPECT_EQ(read.sticks[1].number, 3);
  ASSERT_EQ(read.report.rejected_count, 3);
  EXPECT_EQ(read.report.rejected[0].line, 7);
  EXPECT_EQ(read.report.rejected[0].column, 35);
  EXPECT_NE(read.report.rejected[2].reason.find("ends before the z"), std::string::npos);
  EXPECT_TRUE(says(read.report.assumed, "'Fault_Name' is the fault's name"));
}

TEST(Rms, TextThatIsNoPointIsNotRecognised) {
  EXPECT_FALSE(recognises(""));
  EXPECT_FALSE(recognises("Float\n1 2 3\n"));
  EXPECT_FALSE(recognises("1 2 3 4\n999 999 999 4\n"));
  EXPECT_FALSE(recognises("hello\n999 999 999\n"));
  EXPECT_TRUE(recognises("1 2 3\n1 2\n4 5 6\n999 999 999\n"));  // a bad row is rejected when it is read
  EXPECT_THROW(parse(""), Error);
  EXPECT_THROW(parse("999 999 999\n"), Error);
}

TEST(Rms, WhatIsWrittenIsReadBackTheSame) {
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

TEST(Rms, APointThatLooksLikeTheMarkIsNotWritten) {
  std::vector<std::string> renamed;
  EXPECT_THROW(write(std::vector<Stick>{{"F", 1, {{999, 999, 999}}}}, {}, renamed), Error);
}

TEST(Rms, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kLines, [](const std::string& text) { return parse(text); });
  expect_damage_is_survived("Int Seg\nString Fault\n1 2 3 4 F\n1 2 3 5 G\n",
                            [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::rms
