#include "storage/formats/detail/stick_collector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"
#include "storage/formats/names.h"

namespace footwall::formats::detail {
namespace {

survey::Geometry small_survey() {
  survey::Geometry g;
  g.inlines = {100, 2, 50};
  g.crosslines = {300, 1, 60};
  g.samples = 100;
  g.interval = 4;
  g.map = {1000, 2000, 20, 0, 0, 25};
  return g;
}

SticksOptions surveyed() {
  SticksOptions options;
  options.survey = small_survey();
  options.vertical_unit = "ms";
  return options;
}

// A knot at a voxel of small_survey(), without number.
Knot at(double i, double j, double k) {
  const survey::WorldPoint p = small_survey().world_of({i, j, k});
  return {"F", {}, {}, {{p.x, p.y}}, p.z};
}

std::vector<std::size_t> lengths(const SticksImport& read) {
  std::vector<std::size_t> found;
  for (const Stick& stick : read.sticks) found.push_back(stick.points.size());
  return found;
}

bool any_has(const std::vector<std::string>& lines, std::string_view text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST(StickCollector, NumbersGoBeforeBlankLinesAndTheseBeforePlanes) {
  StickCollector numbered(surveyed());
  for (const std::int64_t stick : {7, 7, 9, 7}) {
    Knot knot = at(static_cast<double>(stick), 1, static_cast<double>(numbered.read()));
    knot.stick = stick;
    numbered.end_stick();
    numbered.add(knot);
  }
  const SticksImport by_number = numbered.finish("x", "");
  EXPECT_EQ(lengths(by_number), (std::vector<std::size_t>{3, 1}));
  EXPECT_EQ(by_number.sticks[1].number, 9);

  StickCollector parted(surveyed());
  parted.end_stick();
  parted.add(at(1, 1, 1));
  parted.add(at(9, 9, 9));
  parted.end_stick();
  parted.end_stick();
  parted.add(at(1, 1, 2));
  parted.end_stick();
  EXPECT_EQ(lengths(parted.finish("x", "")), (std::vector<std::size_t>{2, 1}));
}

TEST(StickCollector, AStickEndsWhereItsPlaneIsLeft) {
  StickCollector sticks(surveyed());
  // On inline 10, jittered by less than half a step; on crossline 7; on a time slice; alone.
  for (const Knot& knot : {at(10, 5, 10), at(10.4, 6, 20), at(9.6, 7, 30), at(20, 7.2, 12), at(24, 7, 40),
                           at(30, 30, 50), at(35, 36, 50.3), at(41, 42, 49.8), at(44, 50, 10)}) {
    sticks.add(knot);
  }
  const SticksImport read = sticks.finish("x", "");
  EXPECT_EQ(lengths(read), (std::vector<std::size_t>{3, 2, 3, 1}));
  EXPECT_EQ(read.sticks[2].number, 3);
  EXPECT_TRUE(any_has(read.report.assumed, "makes 4 sticks"));
}

TEST(StickCollector, WithoutASurveyNothingTellsThePlanes) {
  StickCollector sticks({});
  sticks.add(at(10, 5, 10));
  sticks.add(at(20, 7, 12));
  const SticksImport read = sticks.finish("x", "");
  EXPECT_EQ(lengths(read), (std::vector<std::size_t>{2}));
  EXPECT_TRUE(any_has(read.report.assumed, "one stick"));
  EXPECT_TRUE(any_has(read.report.assumed, "no survey"));
}

TEST(StickCollector, RowsOfAnotherFaultEndAStickWithoutNumber) {
  StickCollector sticks({});
  for (const char* name : {"A", "A", "B", "A"}) {
    Knot knot = at(1, 1, static_cast<double>(sticks.read()));
    knot.name = name;
    sticks.add(knot);
  }
  EXPECT_EQ(lengths(sticks.finish("x", "")), (std::vector<std::size_t>{2, 1, 1}));
}

TEST(StickCollector, ZIsAsToldElseAsStatedElseAssumed) {
  const auto z = [](const SticksOptions& options, std::optional<bool> stated_up,
                    std::string_view stated_unit) {
    StickCollector sticks(options);
    if (stated_up || !stated_unit.empty()) sticks.file_states(stated_up, stated_unit);
    sticks.add({"F", 1, {}, {{1, 2}}, 3});
    return sticks.finish("x", "");
  };
  SticksOptions options;
  options.vertical_unit = "m";
  EXPECT_EQ(z(options, {}, "").sticks[0].points[0].z, 3);
  EXPECT_TRUE(any_has(z(options, {}, "").report.assumed, "z is positive down"));
  EXPECT_TRUE(any_has(z(options, {}, "").report.assumed, "survey's vertical unit"));
  EXPECT_DOUBLE_EQ(z(options, true, "ft").sticks[0].points[0].z, -0.9144);
  EXPECT_TRUE(any_has(z(options, true, "ft").report.assumed, "positive up, as the file says"));
  options.z_positive_up = false;
  options.z_unit = "m";
  EXPECT_EQ(z(options, true, "ft").sticks[0].points[0].z, 3);
  EXPECT_TRUE(any_has(z(options, true, "ft").report.assumed, "in m, as told"));
  options.z_unit = "ms";
  EXPECT_THROW(z(options, {}, ""), Error);
  options.z_unit.clear();
  try {
    z(options, {}, "ms");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalid);
    EXPECT_NE(error.hint().find("--z-unit"), std::string::npos);
  }
}

TEST(StickCollector, LinesPlaceWhatHasNoXAndY) {
  StickCollector sticks(surveyed());
  sticks.add({"F", 1, {{104, 310}}, {}, 8});
  sticks.add({"F", 1, {{105, 310.5}}, {{0, 0}}, 12});
  sticks.add({"F", 1, {{0, 0}}, {{1, 2}}, 16});
  const SticksImport read = sticks.finish("x", "");
  EXPECT_EQ(read.sticks[0].points[0], (survey::WorldPoint{1040, 2250, 8}));
  EXPECT_EQ(read.sticks[0].points[1], (survey::WorldPoint{1050, 2262.5, 12}));
  EXPECT_EQ(read.sticks[0].points[2], (survey::WorldPoint{1, 2, 16}));
  EXPECT_FALSE(read.sticks[0].in_line_numbers);
  EXPECT_TRUE(any_has(read.report.assumed, "1 rows have line numbers 0 0"));
  EXPECT_TRUE(any_has(read.report.assumed, "1 rows have X and Y 0 0"));

  StickCollector without({});
  without.add({"F", 1, {{104, 310}}, {}, 8});
  EXPECT_THROW(without.add({"F", 1, {{104, 310}}, {{0, 0}}, 8}), RowError);
  EXPECT_TRUE(without.finish("x", "").sticks[0].in_line_numbers);
}

TEST(StickCollector, XAndYAtTheOriginAreBelievedWhereTheLinesAgree) {
  SticksOptions options = surveyed();
  options.survey->map = {-20, -25, 20, 0, 0, 25};
  StickCollector sticks(options);
  sticks.add({"F", 1, {{103, 301}}, {{0, 0}}, 8});  // half a line away: rounded when it was written
  EXPECT_EQ(sticks.finish("x", "").sticks[0].points[0], (survey::WorldPoint{0, 0, 8}));
}

TEST(StickCollector, XAndYThatContradictTheLinesAreNoticed) {
  StickCollector sticks(surveyed());
  sticks.add({"F", 1, {{104, 310}}, {{1040, 2250}}, 8});
  sticks.add({"F", 1, {{104, 310}}, {{1059, 2240}}, 9});
  sticks.add({"F", 1, {{104, 310}}, {{1040, 2277}}, 10});
  const SticksImport read = sticks.finish("x", "");
  ASSERT_EQ(read.notices.size(), 1U);  // the second row is within a bin
  EXPECT_NE(read.notices[0].find("1 rows"), std::string::npos);
  EXPECT_NE(read.notices[0].find("1.1 lines"), std::string::npos) << read.notices[0];
}

TEST(StickCollector, NamesAreMadeFitForAProject) {
  SticksOptions options;
  options.fault = "file";
  StickCollector sticks(options);
  const std::string umlauts = std::string("x") + [] {
    std::string text;
    for (int n = 0; n < 150; ++n) text += "\xC3\xA4";
    return text;
  }();
  for (const std::string& name : {std::string("A\t\x01 b"), std::string("A  b"), umlauts + "1", umlauts + "2",
                                  std::string("\xE4"), std::string()}) {
    sticks.add({name, 1, {}, {{1, 2}}, static_cast<double>(sticks.read())});
  }
  const SticksImport read = sticks.finish("x", "");
  ASSERT_EQ(read.sticks.size(), 5U);
  EXPECT_EQ(read.sticks[0].fault, "A b");
  EXPECT_EQ(read.sticks[0].points.size(), 2U);
  EXPECT_EQ(read.sticks[1].fault.size(), 199U);  // no half character
  EXPECT_LE(read.sticks[2].fault.size(), kLongestName);
  EXPECT_TRUE(read.sticks[2].fault.ends_with(" (2)"));
  EXPECT_EQ(read.sticks[3].fault, "\xC3\xA4");
  EXPECT_EQ(read.sticks[4].fault, "file");
  EXPECT_EQ(read.report.renamed.size(), 5U);
}

TEST(StickCollector, ReasonsHoldNoControlCharacters) {
  StickCollector sticks({});
  sticks.reject(3, {4, std::string("'\x1B[2J\0\xFF' is no z", 14)});
  try {
    sticks.finish("a stick", "hint");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.message().find('\x1B'), std::string::npos);
    EXPECT_NE(error.message().find("line 3"), std::string::npos);
  }
}

TEST(StickCollector, WritersTellWhatTheyChange) {
  std::vector<std::string> renamed;
  EXPECT_EQ(written_name("Big  \"one\"", "\"", false, renamed), "Big _one_");
  EXPECT_EQ(written_name("Big one", "\"", true, renamed), "Big_one");
  EXPECT_EQ(written_name("Big one", "\"", true, renamed), "Big_one");
  EXPECT_EQ(written_name("plain", "\"", true, renamed), "plain");
  EXPECT_EQ(renamed, (std::vector<std::string>{"Big  \"one\" -> Big _one_", "Big one -> Big_one"}));
  SticksWriteOptions options;
  EXPECT_EQ(nearest_lines({1, 2, 3}, options), (std::array<std::int64_t, 2>{0, 0}));
  options.survey = small_survey();
  EXPECT_EQ(nearest_lines({1051, 2013, 0}, options), (std::array<std::int64_t, 2>{106, 301}));
  EXPECT_EQ(nearest_lines({1e300, 2013, 0}, options), (std::array<std::int64_t, 2>{0, 0}));
  options.z_positive_up = true;
  EXPECT_FALSE(std::signbit(written_z(0, options)));
}

}  // namespace
}  // namespace footwall::formats::detail
