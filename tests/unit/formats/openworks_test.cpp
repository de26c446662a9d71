#include "storage/formats/openworks.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "damaged_text.h"

namespace footwall::formats::openworks {
namespace {

// The name in 60 characters, which are more bytes where some are not ASCII.
std::string plane(const std::string& name, std::size_t characters, std::string_view domain) {
  return "New Fault Plane, version 1.10\n" + name + std::string(60 - characters, ' ') +
         fmt::format("{:<5}{:<40}UNKNOWN     {:<8}Y\n", "ABC", "survey one", domain);
}

std::string segment(int points, std::string_view domain = "TIME") {
  return fmt::format("Fault Segment\nABC                 {}         1.0002.0003.0\n{:<8}0\n", points, domain);
}

const std::string kFile = plane("\xC3\x86gir fault", 10, "TIME") + segment(2) +
                          "      620553.53     6082070.69   651.57000\r\n"
                          "      620603.51     6082072.09   701.25000\r\n" +
                          segment(1) + "      620653.00     6082073.00   655.5\n" + plane("F2", 2, "TIME") +
                          segment(1) + " 1 2 3\n";

TEST(OpenWorks, APlaneIsAFaultAndASegmentAStick) {
  EXPECT_TRUE(recognises(kFile));
  const SticksImport read = parse(kFile);
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "\xC3\x86gir fault");
  EXPECT_EQ(read.sticks[0].points, (std::vector<survey::WorldPoint>{{620553.53, 6082070.69, 651.57},
                                                                    {620603.51, 6082072.09, 701.25}}));
  EXPECT_EQ(read.sticks[1].number, 2);
  EXPECT_EQ(read.sticks[2].fault, "F2");
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_TRUE(says(read.report.assumed, "z is time, as the file says"));
  EXPECT_FALSE(says(read.report.assumed, "states"));
}

TEST(OpenWorks, ASegmentOfAnotherLengthIsTold) {
  const SticksImport read = parse(plane("F", 1, "DEPTH") + segment(3, "DEPTH") + " 1 2 3\n 1 x 4\n");
  ASSERT_EQ(read.report.rejected_count, 1);
  EXPECT_EQ(read.report.rejected[0].line, 7);
  EXPECT_EQ(read.report.rejected[0].column, 4);
  EXPECT_TRUE(says(read.report.assumed, "line 3: the segment states 3 points and has 2 rows"));
}

TEST(OpenWorks, ASegmentThatBeginsWithABadRowIsAStickOfItsOwn) {
  const SticksImport read =
      parse(plane("F", 1, "TIME") + segment(1) + " 1 2 3\n" + segment(2) + " 1 x 4\n 5 6 7\n");
  ASSERT_EQ(read.sticks.size(), 2u);
  EXPECT_EQ(read.sticks[1].points, (std::vector<survey::WorldPoint>{{5, 6, 7}}));
}

TEST(OpenWorks, TimeDoesNotGoIntoADepthSurvey) {
  SticksOptions options;
  options.vertical_unit = std::string("m");
  EXPECT_THROW(parse(kFile, options), Error);
  options.vertical_unit = std::string("ms");
  EXPECT_EQ(parse(kFile, options).sticks.size(), 3u);
}

TEST(OpenWorks, RowsOutsideOfSegmentsAreRejected) {
  const SticksImport read = parse(plane("F", 1, "TIME") + " 1 2 3\n" + segment(1) + " 1 2 3\n");
  ASSERT_EQ(read.report.rejected_count, 1);
  EXPECT_NE(read.report.rejected[0].reason.find("does not belong"), std::string::npos);
  EXPECT_THROW(parse("New Fault Plane, version 1.10\n"), Error);
  EXPECT_FALSE(recognises("fault plane\n"));
}

TEST(OpenWorks, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kFile, [](const std::string& text) { return parse(text); });
}

}  // namespace
}  // namespace footwall::formats::openworks
