#include "storage/formats/stick_formats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats {
namespace {

survey::Geometry utm_survey() {
  survey::Geometry g;
  g.inlines = {1000, 2, 400};
  g.crosslines = {2000, 1, 500};
  g.samples = 500;
  g.interval = 4;
  g.map = {458177.76709, 7322538.712891, 20.3, 14.7, -9.1, 8.6};
  return g;
}

// Two faults with ugly names, a stick of one node, sticks of many directions; z in ms.
std::vector<Stick> ugly_sticks(bool one_fault) {
  const survey::Geometry g = utm_survey();
  const auto at = [&](double i, double j, double k) { return g.world_of({i, j, k}); };
  std::vector<Stick> sticks{
      {"Störung 7 West", 1, {at(10.2, 20.4, 100.123456), at(10.2, 21.7, 140.7), at(10.2, 19.9, 181.1)}},
      {"Störung 7 West", 2, {at(30, 20, 99.9)}},
      {"Störung 7 West", 3, {at(51.3, 77.77, 300), at(42.1, 70.3, 200), at(60.7, 80.8, 100.5)}},
  };
  if (!one_fault) {
    sticks.push_back({"B (2)", 1, {at(0, 0, 0), at(0, 1, 10)}});
    sticks.push_back({"B (2)", 2, {at(399, 499, 499), at(399, 498, 490.25)}});
  }
  return sticks;
}

struct RoundTrip {
  std::string format;
  bool z_up;
  std::string unit;
  bool crlf;
};

class EveryWrittenFormat : public ::testing::TestWithParam<RoundTrip> {};

std::vector<RoundTrip> every_round_trip() {
  std::vector<RoundTrip> all;
  for (const StickFormat& format : stick_formats()) {
    if (format.write == nullptr) continue;
    for (const bool up : {false, true}) {
      for (const char* unit : {"ms", "s", "m", "ft"}) {
        all.push_back({std::string(format.name), up, unit, up});
      }
    }
  }
  return all;
}

std::string with_crlf(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

TEST_P(EveryWrittenFormat, ReadsBackWhatItWrote) {
  const RoundTrip& form = GetParam();
  const StickFormat& format = stick_format(form.format);
  const std::vector<Stick> sticks = ugly_sticks(format.one_fault);
  SticksWriteOptions how;
  how.z_positive_up = form.z_up;
  how.vertical_unit = form.unit;
  how.survey = utm_survey();
  how.survey->vertical_unit = form.unit == "m"    ? survey::VerticalUnit::kMetre
                              : form.unit == "ft" ? survey::VerticalUnit::kFoot
                                                  : survey::VerticalUnit::kMillisecond;
  std::vector<Stick> in_unit = sticks;
  const double factor = form.unit == "s" ? 0.001 : 1;
  for (Stick& stick : in_unit) {
    for (survey::WorldPoint& point : stick.points) point.z *= factor;
  }
  std::vector<std::string> renamed;
  const std::string text = format.write(in_unit, how, renamed);

  SticksOptions options;
  options.z_positive_up = form.z_up;
  options.z_unit = form.unit;
  options.vertical_unit = form.unit == "s" ? "ms" : form.unit;
  options.fault = sticks.front().fault;
  options.survey = how.survey;
  const SticksImport read = format.parse(form.crlf ? with_crlf(text) : text, options);
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_TRUE(read.notices.empty());
  ASSERT_EQ(read.sticks.size(), sticks.size()) << text;
  for (std::size_t n = 0; n < sticks.size(); ++n) {
    if (renamed.empty()) {
      EXPECT_EQ(read.sticks[n].fault, sticks[n].fault);
    }
    ASSERT_EQ(read.sticks[n].points.size(), sticks[n].points.size()) << text;
    for (std::size_t p = 0; p < sticks[n].points.size(); ++p) {
      // Half of the last digit that any format is asked for, 1e-3.
      EXPECT_NEAR(read.sticks[n].points[p].x, sticks[n].points[p].x, 5.001e-4);
      EXPECT_NEAR(read.sticks[n].points[p].y, sticks[n].points[p].y, 5.001e-4);
      EXPECT_NEAR(read.sticks[n].points[p].z, sticks[n].points[p].z, 5.001e-4);
    }
  }

  // Once rounded, nothing changes any more: the file is the same to the letter.
  std::vector<Stick> again = read.sticks;
  for (Stick& stick : again) {
    for (survey::WorldPoint& point : stick.points) point.z *= factor;
  }
  std::vector<std::string> renamed_again;
  EXPECT_EQ(format.write(again, how, renamed_again), text);
  EXPECT_TRUE(renamed_again.empty());
}

INSTANTIATE_TEST_SUITE_P(SticksOf, EveryWrittenFormat, ::testing::ValuesIn(every_round_trip()),
                         [](const auto& form) {
                           std::string name =
                               form.param.format + (form.param.z_up ? "_up_" : "_down_") + form.param.unit;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

TEST(StickFormats, EachIsRecognisedByWhatItWrites) {
  const ScratchFolder folder;
  for (const StickFormat& format : stick_formats()) {
    if (format.write == nullptr || format.recognises == nullptr) continue;
    SticksWriteOptions how;
    how.survey = utm_survey();
    how.vertical_unit = "ms";
    write_sticks(folder / "f.dat", format.name, ugly_sticks(format.one_fault), how);
    EXPECT_EQ(read_sticks(folder / "f.dat", "", {}).format, format.name);
  }
}

void expect_refused(const std::function<void()>& call, ErrorCode code, std::string_view message,
                    std::string_view hint) {
  try {
    call();
    ADD_FAILURE() << "was done";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(error.message().find(message), std::string::npos) << error.message();
    EXPECT_NE(error.hint().find(hint), std::string::npos) << error.hint();
  }
}

TEST(StickFormats, AFileThatIsSomethingElseIsRefusedByItsName) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& content, std::string_view what, std::string_view use) {
    const auto path = folder.file("f", content);
    expect_refused([&] { read_sticks(path, "", {}); }, ErrorCode::kFormat, what, use);
  };
  refused("GOCAD TSurf 1\nHEADER {\nname:F\n}\nTFACE\nEND\n", "a GOCAD TSurf", "import surface");
  refused("GOCAD VSet 1\n", "without PLine", "PLine");
  refused("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n", "VTK XML", "");
  refused("! made by hand\n@grid, GRID, 5\n", "ZMAP+ grid", "");
  refused("-996 3 25.0 25.0\n1 2 3 4\n", "IRAP classic grid", "");
  refused("Float Dip\n1 2 3 4\n", "RMS points", "--columns");
  refused("#Type: scattered data\n1 2 3\n", "scattered", "--columns");
  refused("\xFF\xFE\x31\x00", "UTF-16", "UTF-8");
  refused(std::string("\x1F\x8B\x08\x00", 4), "gzip", "decompress");
  refused("SQLite format 3", "database", "");
  refused(std::string("1 2\0 3\n", 7), "binary", "");
  refused("INLINE :10 XLINE :20 1 2 3\n", "horizon", "INLINE");
  refused("Dear Sir,\nfaults are bad.\n", "no format", "--columns");
  refused("", "no format", "--format");
  std::string segy(3600, ' ');
  segy.replace(3200, 400, 400, '\0');
  segy[3221] = 10;
  segy[3225] = 5;
  refused(segy + std::string(2 * (240 + 40), '\0'), "SEG-Y", "import volume");
  // The same when the format was named wrongly: the reason, and what the file looks like.
  const auto tsurf = folder.file("t.ts", "GOCAD TSurf 1\nVRTX 1 0 0 0\n");
  expect_refused([&] { read_sticks(tsurf, "charisma", {}); }, ErrorCode::kFormat, "no row is a Charisma",
                 "import surface");
  expect_refused([&] { read_sticks(tsurf, "petrol", {}); }, ErrorCode::kUsage, "petrol", "charisma");
}

TEST(StickFormats, ReadsTextsOfEveryRowEnding) {
  const ScratchFolder folder;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto path =
        folder.file("f", "\xEF\xBB\xBF# c" + end + "1 2 3 1" + end + "1 2 4 1" + end + "1 2 5 2");
    const SticksImport read = read_sticks(path, "", {});
    EXPECT_EQ(read.format, "xyz");
    EXPECT_EQ(read.sticks.size(), 2U);
    EXPECT_EQ(read.report.read, 3);
    EXPECT_EQ(read.report.skipped, 1);
    EXPECT_EQ(read.sticks[0].fault, "f");
  }
}

TEST(StickFormats, AFileOfOneFaultRefusesSeveral) {
  const ScratchFolder folder;
  expect_refused([&] { write_sticks(folder / "o", "xyz", ugly_sticks(false), {}); }, ErrorCode::kUsage,
                 "one fault", "--fault");
  EXPECT_FALSE(std::filesystem::exists(folder / "o"));
  EXPECT_EQ(write_sticks(folder / "o", "xyz", ugly_sticks(true), {}).size(), 1U);
  expect_refused([&] { write_sticks(folder / "o", "xyz", {}, {}); }, ErrorCode::kInvalid, "no fault sticks",
                 "");
}

TEST(ZUnit, ConvertsWithinADomainOnly) {
  EXPECT_EQ(z_unit_factor("s", "ms"), 1000);
  EXPECT_EQ(z_unit_factor("ft", "m"), 0.3048);
  EXPECT_EQ(z_unit_factor("m", "m"), 1);
  EXPECT_NEAR(z_unit_factor("m", "ft") * 0.3048, 1, 1e-15);
  EXPECT_THROW(z_unit_factor("ft", "ms"), Error);
  EXPECT_THROW(z_unit_factor("km", "m"), Error);
  EXPECT_EQ(z_unit_from(" MSEC "), "ms");
  EXPECT_EQ(z_unit_from("Feet"), "ft");
  EXPECT_FALSE(z_unit_from("furlong"));
}

}  // namespace
}  // namespace footwall::formats
