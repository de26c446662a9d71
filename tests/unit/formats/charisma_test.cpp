#include "storage/formats/charisma.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/stick_formats.h"

namespace footwall::formats::charisma {
namespace {

TEST(Charisma, ReadsSticksWithNamesThatHaveBlanks) {
  const SticksImport read = parse(
      "INLINE- 10 203 500075.00 6700000.25 33.0000 Big Boundary Fault 4\n"
      "INLINE- 10 204 500100.00 6700000.25 66.5 Big Boundary Fault 4\n"
      "INLINE- 20 203 500075.00 6700100.25 33.0 Big Boundary Fault 5\n"
      "INLINE- 20 204 1 2 3 F2 5\n");
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "Big Boundary Fault");
  EXPECT_EQ(read.sticks[0].number, 4);
  ASSERT_EQ(read.sticks[0].points.size(), 2u);
  EXPECT_EQ(read.sticks[0].points[0], (survey::WorldPoint{500075.00, 6700000.25, 33}));
  EXPECT_EQ(read.sticks[2].fault, "F2");
  EXPECT_EQ(read.report.read, 4);
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_FALSE(read.report.assumed.empty());
}

TEST(Charisma, TakesTheVariantsOfTheWild) {
  const SticksImport read = parse(
      "\xEF\xBB\xBF# exported by nobody\r\n"
      "INLINE CROSSLINE X Y Z NAME STICK\r\n"
      "Line  Trace  X Y\r\n"
      "\r\n"
      "INLINE -  10 203 1 2 3 F 1\r\n"
      "INLINE-1002 203 1 2 4 F 1\r\n"
      "inline :1002 xline :2002 1 2 5 F 1\r\n"
      "\tINLINE-\t10\t203\t1\t2\t6\t\"F\"\t1\r\n"
      "  INLINE- 0 0 1 2 7 'F' 1\r\n"
      "INLINE- -10 -20 1 2 8e0 F 1\r\n"
      "INLINE- 10 20 1 2 9 F 1.0\r\n"
      "! the end");
  ASSERT_EQ(read.sticks.size(), 1u);
  ASSERT_EQ(read.sticks[0].points.size(), 7u)
      << (read.report.rejected.empty() ? "" : read.report.rejected[0].reason);
  for (std::size_t n = 0; n < 7; ++n) EXPECT_EQ(read.sticks[0].points[n].z, 3.0 + static_cast<double>(n));
  EXPECT_EQ(read.sticks[0].fault, "F");
  bool placed = false;
  for (const std::string& line : read.report.assumed) placed |= line.find("0 0") != std::string::npos;
  EXPECT_TRUE(placed);
}

TEST(Charisma, RejectsBadRowsWithTheirPlaceAndGoesOn) {
  const SticksImport read = parse(
      "INLINE- 10 203 1 2 3 F 1\n"
      "INLINE- 10 203 1 x 3 F 1\n"
      "INLINE- 10 203 1 2\n"
      "INLINE :10 XLINE :20 1 2 3\n"
      "INLINE- 10 203 1 2 3\n"
      "INLINE- 10 203 1 2 3 F one\n"
      "INLINE- 10 203 1 2 1e30 F 1\n"
      "INLINE- 10 203 nan 2 3 F 1\n"
      "10 203 1 2 3 F 1\n"
      "INLINE- 10 203 1 2 4 F 1\n");
  EXPECT_EQ(read.report.read, 2);
  ASSERT_EQ(read.report.rejected_count, 8);
  const auto& rejected = read.report.rejected;
  EXPECT_EQ(rejected[0].line, 2);
  EXPECT_EQ(rejected[0].column, 18);
  EXPECT_NE(rejected[0].reason.find("'x'"), std::string::npos);
  EXPECT_NE(rejected[1].reason.find("ends before the z"), std::string::npos);
  EXPECT_NE(rejected[2].reason.find("horizon"), std::string::npos);
  EXPECT_NE(rejected[3].reason.find("no fault name"), std::string::npos);
  EXPECT_EQ(rejected[4].column, 24);
  EXPECT_NE(rejected[5].reason.find("null value"), std::string::npos);
  EXPECT_EQ(rejected[7].line, 9);
}

TEST(Charisma, NamesAreCleanedAndReported) {
  const SticksImport read = parse(
      "INLINE- 1 2 1 2 3 Big\t fault 1\nINLINE- 1 2 1 2 4 Big\t fault 1\n"
      "INLINE- 1 2 1 2 5 \xC6re 2\nINLINE- 1 2 1 2 6 3\n");
  ASSERT_EQ(read.sticks.size(), 3u);
  EXPECT_EQ(read.sticks[0].fault, "Big fault");
  EXPECT_EQ(read.sticks[1].fault, "\xC3\x86re");
  EXPECT_EQ(read.sticks[2].fault, "unnamed");
  EXPECT_EQ(read.sticks[2].number, 3);
  EXPECT_EQ(read.report.renamed.size(), 2u);
}

TEST(Charisma, RepeatedKnotsAndElevations) {
  SticksOptions options;
  options.z_positive_up = true;
  const SticksImport read =
      parse("INLINE- 1 2 1 2 -3 F 1\nINLINE- 1 2 1 2 -3 F 1\nINLINE- 1 2 1 2 -4 F 1\n", options);
  ASSERT_EQ(read.sticks[0].points.size(), 2u);
  EXPECT_EQ(read.sticks[0].points[0].z, 3);
  EXPECT_EQ(read.report.skipped, 1);
}

TEST(Charisma, AFileWithoutSticksIsRefusedWithTheFirstReason) {
  const ScratchFolder folder;
  const auto path = folder.file("h.dat", "INLINE :10 XLINE :20 1 2 3\nINLINE :10 XLINE :21 1 2 3\n");
  try {
    read_sticks(path, "", {});
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("horizon"), std::string::npos);
    EXPECT_NE(error.message().find("h.dat"), std::string::npos);
  }
  EXPECT_THROW(parse(""), Error);
  EXPECT_THROW(parse(std::string("\0\xFF\xFE garbage \n\n\n", 14)), Error);
  EXPECT_THROW(read_sticks(folder / "none", "", {}), Error);
}

TEST(Charisma, ManyRejectsAreCountedButNotAllKept) {
  std::string text = "INLINE- 1 2 1 2 3 F 1\n";
  for (int n = 0; n < 5000; ++n) text += "INLINE- 1 2 1 2 3\n";
  const SticksImport read = parse(text);
  EXPECT_EQ(read.report.rejected_count, 5000);
  EXPECT_EQ(read.report.rejected.size(), ImportReport::kListedRejects);
}

}  // namespace
}  // namespace footwall::formats::charisma
