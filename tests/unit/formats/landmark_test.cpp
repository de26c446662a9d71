#include "storage/formats/landmark.h"

#include <gtest/gtest.h>

#include "damaged_text.h"

namespace footwall::formats::landmark {
namespace {

const std::string kLayout =
    "# columns\nFAULT_X 1 12\nFAULT_Y 13 24\r\nFAULT_Z 25 34\nFAULT_PTYPE 35 36\nFAULT_DOMAIN 38 42\n"
    "FAULT_DOMAIN_UNIT 44 45\nFAULT_SURVEY 50 60\n";
const std::string kFile =
    "   620553.53  6082070.69    651.57 1 TIME  ms\n"
    "   620603.51  6082072.09    701.25 2 TIME  ms\n"
    "   620653.00  6082073.00    751.50 3 TIME  ms\n"
    "   620753.00  6082173.00    655.50 1 TIME  ms\n"
    "   620853.00  6082273.00    655.50 1 TIME  ms\n"
    "   620863.00  6082273.00    665.50 4 TIME  ms\n"
    "   620873.00  6082273.00    675.50 3 TIME  ms\n"
    "   620973.00  6082273.00    675.50 2 TIME  ms\n";

SticksOptions with_layout(std::string_view layout = kLayout) {
  return {.fault = std::string("F"), .layout = std::string(layout)};
}

TEST(Landmark, PointTypesPartSticks) {
  const SticksImport read = parse(kFile, with_layout());
  ASSERT_EQ(read.sticks.size(), 4u);
  EXPECT_EQ(read.sticks[0].points.size(), 3u);
  EXPECT_EQ(read.sticks[0].points[1], (survey::WorldPoint{620603.51, 6082072.09, 701.25}));
  EXPECT_EQ(read.sticks[1].points.size(), 1u);
  EXPECT_EQ(read.sticks[2].points.size(), 3u);
  EXPECT_EQ(read.sticks[3].points.size(), 1u);
  EXPECT_TRUE(says(read.report.assumed, "z is in ms, as the file says"));
  EXPECT_TRUE(says(read.report.assumed, "control points"));
  EXPECT_TRUE(says(read.report.assumed, "follows an end"));
}

TEST(Landmark, UnitsAreConvertedAndContradictionsRejected) {
  SticksOptions options = with_layout();
  options.vertical_unit = std::string("m");
  const SticksImport read = parse(
      "   620553.53  6082070.69    100.00 1 DEPTH ft\n"
      "   620553.53  6082070.69    200.00 2 DEPTH ms\n"
      "   620553.53  6082070.69    200.00 2 DEPTH xx\n"
      "   620553.53  6082070.69    200.00 9 DEPTH ft\n"
      "   620553.53  6082070.69    200.0x 2 DEPTH ft\n"
      "   620553.53\n",
      options);
  ASSERT_EQ(read.sticks.size(), 1u);
  EXPECT_DOUBLE_EQ(read.sticks[0].points.at(0).z, 30.48);
  ASSERT_EQ(read.report.rejected_count, 5);
  EXPECT_EQ(read.report.rejected[0].column, 38);
  EXPECT_NE(read.report.rejected[1].reason.find("'xx'"), std::string::npos);
  EXPECT_NE(read.report.rejected[2].reason.find("point type 9"), std::string::npos);
  EXPECT_EQ(read.report.rejected[3].column, 29);
  EXPECT_THROW(parse(kFile, options), Error);  // ms into m
}

TEST(Landmark, AStartWithABadPositionStartsAStickNonetheless) {
  const SticksImport read = parse(
      "   620553.53  6082070.69    651.57 1 TIME  ms\n"
      "   620553.53  6082070.x9    651.57 1 TIME  ms\n"
      "   620653.53  6082070.69    651.57 2 TIME  ms\n",
      with_layout());
  EXPECT_EQ(read.report.rejected_count, 1);
  EXPECT_EQ(read.sticks.size(), 2u);
}

TEST(Landmark, LinesAndTracesPlacePointsWhereThereIsNoXY) {
  const SticksImport read =
      parse(" 100 200 651.5 1\n 101 200 661.5 3\n",
            with_layout("FAULT_LINEID 1 4\nFAULT_TRACE 5 8\nFAULT_Z 9 14\nFAULT_PTYPE 15 16\n"));
  ASSERT_EQ(read.sticks.size(), 1u);
  EXPECT_TRUE(read.sticks[0].in_line_numbers);
  EXPECT_EQ(read.sticks[0].points.at(1), (survey::WorldPoint{101, 200, 661.5}));
}

TEST(Landmark, WithoutAUsableFormatFileNothingIsRead) {
  try {
    parse(kFile);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    EXPECT_NE(error.message().find("format file"), std::string::npos);
  }
  for (const std::string_view bad :
       {"FAULT_X 1 12\n", "FAULT_X 12 1\n", "FAULT_X 0 5\n", "FAULT_X\n", "FAULT_X 1 99999999999999\n",
        "FAULT_X 1 2\nFAULT_Y 3 4\nFAULT_Z 5 6\n"}) {
    EXPECT_THROW(parse(kFile, with_layout(bad)), Error) << bad;
  }
}

TEST(Landmark, DamagedFilesAreReadOrRefused) {
  expect_damage_is_survived(kFile, [](const std::string& text) { return parse(text, with_layout()); });
  expect_damage_is_survived(kLayout, [](const std::string& text) { return parse(kFile, with_layout(text)); });
}

}  // namespace
}  // namespace footwall::formats::landmark
