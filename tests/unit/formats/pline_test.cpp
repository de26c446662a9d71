#include "storage/formats/pline.h"

#include <gtest/gtest.h>

#include "damaged_text.h"

namespace footwall::formats::pline {
namespace {

// Two objects, CR LF, blanks at the ends of rows, blocks of properties, ids from anywhere, an ATOM.
const std::string kFile =
    "GOCAD PLine 1 \r\n"
    "HEADER { \r\n"
    "*color: 1 0 0 1\r\n"
    "name: Big fault\r\n"
    "}\r\n"
    "GOCAD_ORIGINAL_COORDINATE_SYSTEM\r\n"
    "NAME \"Local\"\r\n"
    "AXIS_NAME X Y Z\r\n"
    "AXIS_UNIT m m m\r\n"
    "ZPOSITIVE Elevation\r\n"
    "END_ORIGINAL_COORDINATE_SYSTEM\r\n"
    "PROPERTIES var\r\n"
    "PROPERTY_CLASS_HEADER Z {\r\n"
    "kind: Depth\r\n"
    "is_z: on\r\n"
    "}\r\n"
    "ILINE\r\n"
    "VRTX 7 314590 6074560.25 -353.5 \r\n"
    "PVRTX 3 314590 6074550 -350 0.5\r\n"
    "VRTX 9 314591 6074551 -340\r\n"
    "SEG 9 3 \r\n"
    "SEG 7 3\r\n"
    "ILINE\r\n"
    "VRTX 10 1 2 -3\r\n"
    "VRTX 11 2 2 -3\r\n"
    "ATOM 12 7\r\n"
    "SEG 10 11\r\n"
    "SEG 11 12\r\n"
    "SEG 12 10\r\n"
    "END\r\n"
    "GOCAD PLine 1\r\n"
    "HEADER {name:F2}\r\n"
    "GOCAD_ORIGINAL_COORDINATE_SYSTEM\r\n"
    "ZPOSITIVE Depth\r\n"
    "END_ORIGINAL_COORDINATE_SYSTEM\r\n"
    "ILINE\r\n"
    "VRTX 0 5 6 7\r\n"
    "END\r\n";

TEST(PLine, PointsAreOrderedAlongTheSegments) {
  const SticksImport read = parse(kFile);
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "Big fault");
  EXPECT_EQ(read.sticks[0].number, 1);
  using Points = std::vector<survey::WorldPoint>;
  EXPECT_EQ(read.sticks[0].points,
            (Points{{314590, 6074560.25, 353.5}, {314590, 6074550, 350}, {314591, 6074551, 340}}));
  EXPECT_EQ(read.sticks[1].points, (Points{{1, 2, 3}, {2, 2, 3}, {314590, 6074560.25, 353.5}, {1, 2, 3}}));
  EXPECT_EQ(read.sticks[2].fault, "F2");
  EXPECT_EQ(read.sticks[2].points, (Points{{5, 6, 7}}));
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_TRUE(says(read.report.assumed, "z is in m, as the file says"));
}

TEST(PLine, WithoutZpositiveZIsElevationAndToldSo) {
  const std::string text = "GOCAD PLine 1\nHEADER {\nname:F\n}\nILINE\nVRTX 1 1 2 -3\nVRTX 2 1 2 -4\nEND\n";
  const SticksImport read = parse(text);
  EXPECT_EQ(read.sticks.at(0).points.at(1).z, 4);
  EXPECT_TRUE(says(read.report.assumed, "GOCAD's default"));
  EXPECT_TRUE(says(read.report.assumed, "ILINE without SEG"));
  SticksOptions told;
  told.z_positive_up = false;
  EXPECT_EQ(parse(text, told).sticks.at(0).points.at(1).z, -4);
}

TEST(PLine, ALineOfTheSameNameInAnotherObjectIsAnotherStick) {
  const std::string object =
      "GOCAD PLine 1\nHEADER {\nname:F\n}\nILINE\nVRTX 1 1 2 3\nVRTX 2 1 2 4\nSEG 1 2\n";
  const SticksImport read = parse(object + "END\n" + object);
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[1].number, 2);
  EXPECT_TRUE(says(read.report.assumed, "no END"));
}

TEST(PLine, BadRowsAreRejectedWithTheirPlace) {
  const SticksImport read = parse(
      "GOCAD PLine 1\nILINE\nVRTX 1 1 2 3\nVRTX 2 1 x 3\nVRTX 3 1 2 1e30\nVRTX 4 1 2\nSEG 1 2\nATOM 5 99\n"
      "SEG 1 1\nVRTX 6 8 8 8\nSEG 1 6\nZPOSITIVE Sideways\nEND\n");
  ASSERT_EQ(read.report.rejected_count, 7);
  EXPECT_EQ(read.report.rejected[0].line, 4);
  EXPECT_EQ(read.report.rejected[0].column, 10);
  EXPECT_NE(read.report.rejected[1].reason.find("null"), std::string::npos);
  EXPECT_NE(read.report.rejected[3].reason.find("no point 2"), std::string::npos);
  ASSERT_EQ(read.sticks.size(), 1u);
  EXPECT_EQ(read.sticks[0].points.size(), 2u);
  EXPECT_EQ(read.sticks[0].fault, "unnamed");
}

TEST(PLine, OtherObjectsAreLeftOutOrRefusedByName) {
  const std::string surface = "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nEND\n";
  const SticksImport read = parse(surface + "GOCAD PLine 1\nILINE\nVRTX 1 1 2 3\nEND\n");
  EXPECT_EQ(read.sticks.size(), 1u);
  EXPECT_TRUE(says(read.notices, "TSurf"));
  EXPECT_TRUE(recognises(surface + "GOCAD PLine 1\n"));
  EXPECT_FALSE(recognises(surface));
  try {
    parse(surface);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("TSurf"), std::string::npos);
    EXPECT_NE(error.hint().find("import surface"), std::string::npos);
  }
}

TEST(PLine, PointsOfASetAreSticksOfOne) {
  const SticksImport read =
      parse("GOCAD VSet 1\nHEADER {\nname: picks\n}\nVRTX 1 1 2 3\nVRTX 2 4 5 6\nEND\n");
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[1].points.size(), 1u);
  EXPECT_EQ(read.sticks[1].number, 2);
}

TEST(PLine, WhatIsWrittenIsReadBackTheSame) {
  for (const bool up : {false, true}) {
    SticksWriteOptions options;
    options.z_positive_up = up;
    options.vertical_unit = std::string("ft");
    std::vector<std::string> renamed;
    const std::string text = write(sample_sticks(false), options, renamed);
    EXPECT_TRUE(renamed.empty());
    EXPECT_TRUE(recognises(text));
    EXPECT_NE(text.find(up ? "ZPOSITIVE Elevation" : "ZPOSITIVE Depth"), std::string::npos);
    SticksOptions in;
    in.vertical_unit = std::string("ft");
    const SticksImport read = parse(text, in);
    expect_same_sticks(sample_sticks(false), read.sticks);
    EXPECT_TRUE(says(read.report.assumed, "z is in ft"));
  }
}

TEST(PLine, NamesThatWouldEndTheHeaderAreChangedAndTold) {
  std::vector<std::string> renamed;
  const std::string text = write(std::vector<Stick>{{"F{1}", 1, {{1, 2, 3}}}}, {}, renamed);
  EXPECT_EQ(renamed, (std::vector<std::string>{"F{1} -> F_1_"}));
  EXPECT_EQ(parse(text).sticks.at(0).fault, "F_1_");
}

TEST(PLine, NamesThatBecomeTheSameStayApart) {
  std::vector<std::string> renamed;
  const std::string text =
      write(std::vector<Stick>{{"F_1", 1, {{1, 2, 3}}}, {"F{1", 1, {{4, 5, 6}}}}, {}, renamed);
  EXPECT_TRUE(says(renamed, "F{1 -> F_1_2"));
  EXPECT_EQ(parse(text).sticks.at(1).fault, "F_1_2");
}

TEST(PLine, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kFile, [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::pline
