#include "storage/formats/iesx.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "damaged_text.h"

namespace footwall::formats::iesx {
namespace {

std::string header(std::string_view name, std::string_view ifdf) {
  return fmt::format("PROFILE {:<17}TYPE 1  4 {:<45}{:<18} m  ms\nSNAPPING PARAMETERS 5     0 1\n", name,
                     "by hand", ifdf);
}

std::string row(double x, double y, int segment, double z, double crossline = 896) {
  return fmt::format("{:16.8E}{:16.8E}{:3}{:3}{:9.2f}{:10.2f}{:10.2f}\n", x, y, segment, 14, z, crossline,
                     crossline);
}

const std::string kFile = header("Fault A", "fault_gf.ifdf") + row(620553.531, 6082070.69, 1, 651.57) +
                          row(620603.511, 6082072.09, 1, 701.25) + row(620653, 6082073, 2, 655.5) + "EOD\n" +
                          header("Fault B 12345678x", "fault_gf.ifdf") + row(1, 2, 1, 3) + "EOD\n";

TEST(Iesx, AProfileIsAFaultAndASegmentAStick) {
  EXPECT_TRUE(recognises(kFile));
  const SticksImport read = parse(kFile);
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "Fault A");
  EXPECT_EQ(read.sticks[0].points, (std::vector<survey::WorldPoint>{{620553.531, 6082070.69, 651.57},
                                                                    {620603.511, 6082072.09, 701.25}}));
  EXPECT_EQ(read.sticks[1].number, 2);
  EXPECT_EQ(read.sticks[2].fault, "Fault B 12345678x");
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_TRUE(says(read.report.assumed, "z is in ms, as the file says"));
}

TEST(Iesx, EodInFrontOfRowsAndEchoesOfRows) {
  const SticksImport read =
      parse(header("F", "fault_gf.ifdf") + "EOD" + row(620553.531, 6082070.69, 1, 651.57) +
            "\t651.574611663818359\r\nEOD" + row(620603.511, 6082072.09, 1, 651.17) + "\t651.17\nEOD\n" +
            row(1, 2, 1, 3));
  ASSERT_EQ(read.sticks.size(), 1u);
  EXPECT_EQ(read.sticks[0].points.size(), 2u);
  EXPECT_EQ(read.sticks[0].points[0].z, 651.57);
  ASSERT_EQ(read.report.rejected_count, 1);
  EXPECT_NE(read.report.rejected[0].reason.find("between EOD"), std::string::npos);
}

TEST(Iesx, ANullThatOverflowsItsColumnsIsRejected) {
  const SticksImport read =
      parse(header("F", "fault_gf.ifdf") + row(1, 2, 1, 3.4028235e38) + row(1, 2, 1, 4));
  ASSERT_EQ(read.report.rejected_count, 1);
  EXPECT_EQ(read.report.rejected[0].line, 3);
  EXPECT_EQ(read.report.rejected[0].column, 39);
  EXPECT_NE(read.report.rejected[0].reason.find("null"), std::string::npos);
  EXPECT_EQ(read.sticks.at(0).points.size(), 1u);
}

TEST(Iesx, NineColumnsOfZBesideTenOfTheNextAreNoOverflow) {
  const SticksImport read = parse(header("F", "fault_gf.ifdf") + row(1, 2, 1, -12345.67, 1000000.25));
  EXPECT_EQ(read.sticks.at(0).points.at(0).z, -12345.67);
}

TEST(Iesx, SegmentNumbersOfSevenDigits) {
  const SticksImport read =
      parse(header("F", "") + fmt::format("{:16.4f}{:16.4f}{:07}{:8.2f}\n", 1.5, 2.5, 12, 651.57));
  EXPECT_EQ(read.sticks.at(0).number, 12);
  EXPECT_EQ(read.sticks.at(0).points.at(0).z, 651.57);
  EXPECT_TRUE(says(read.report.assumed, "do not name an ifdf"));
}

TEST(Iesx, FaultBoundariesHaveTheirSegmentInColumns29To31) {
  const SticksImport read = parse(
      "PROFILE fb_test          TYPE 3\n"
      "    1267559.8   263375.0      2     0.0\n"
      "    1289772.9   269848.1      2     0.0\n"
      "    1267559.8   263375.0      2     0.0\n"
      "    1275448.6   233907.2      3  1652.0\n"
      "    1275654.1   235548.1         1624.0\n"
      "EOD\n");
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[0].fault, "fb_test");
  ASSERT_EQ(read.sticks[0].points.size(), 3u);
  EXPECT_EQ(read.sticks[0].points.front(), read.sticks[0].points.back());
  EXPECT_EQ(read.sticks[1].number, 3);
  EXPECT_EQ(read.sticks[1].points.at(0), (survey::WorldPoint{1275448.6, 233907.2, 1652.0}));
  EXPECT_EQ(read.report.rejected_count, 1);
}

TEST(Iesx, HorizonsAreLeftOutByName) {
  const std::string horizon = header("H1", "3d_ci7m.ifdf") + row(1, 2, 0, 3) + "EOD\n";
  const SticksImport read = parse(horizon + kFile);
  EXPECT_EQ(read.sticks.size(), 3u);
  ASSERT_EQ(read.report.rejected_count, 1);
  EXPECT_NE(read.report.rejected[0].reason.find("'H1' is no fault but a horizon"), std::string::npos);
  try {
    parse(horizon);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("H1"), std::string::npos);
  }
}

TEST(Iesx, BadRowsAreRejectedWithTheirPlace) {
  const SticksImport read =
      parse(header("F", "fault_gf.ifdf") + "         1.0x            2.0  1 14   651.57\n" +
            "             1.0             2.0    14   651.57\n" + "             1.0\n" + row(1, 2, 1, 3));
  ASSERT_EQ(read.report.rejected_count, 3);
  EXPECT_EQ(read.report.rejected[0].column, 10);
  EXPECT_NE(read.report.rejected[1].reason.find("segment number is missing"), std::string::npos);
  EXPECT_NE(read.report.rejected[2].reason.find("Y coordinate is missing"), std::string::npos);
  EXPECT_THROW(parse(""), Error);
}

TEST(Iesx, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(
      kFile + header("H", "3d_ci7m.ifdf") + "PROFILE b TYPE 3\n 1 2                       2  3.0\n",
      [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::iesx
