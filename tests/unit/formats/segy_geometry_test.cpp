// The survey that the headers make: lines, map, samples, gaps, doubled traces; and blocks read through the
// index.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "scratch_folder.h"
#include "segy_sample_file.h"
#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {
namespace {

struct Block {
  std::vector<float> values;
  std::vector<std::uint8_t> live;
};

Block read(const SegyFile& file, const survey::Box& box) {
  Block block{std::vector<float>(static_cast<std::size_t>(box.count()), -1.0f),
              std::vector<std::uint8_t>(static_cast<std::size_t>(box.size(0) * box.size(1)), 9)};
  file.read_block(box, block.values, block.live);
  return block;
}

SegyFile scan(const SampleSegy& made, const Options& options = {}) {
  const ScratchFolder folder;
  return SegyFile::scan(folder.file("a.sgy", made.bytes()), options);  // stays open after its removal
}

ErrorCode refusal(const SampleSegy& made, const Options& options = {}) {
  try {
    scan(made, options);
  } catch (const Error& error) {
    EXPECT_FALSE(error.hint().empty()) << error.message();
    return error.code();
  }
  ADD_FAILURE() << "was read";
  return ErrorCode::kInternal;
}

bool mentions(const std::vector<std::string>& lines, const std::string& what) {
  for (const std::string& line : lines) {
    if (line.find(what) != std::string::npos) return true;
  }
  return false;
}

TEST(SegyGeometry, LinesMapAndSamples) {
  const SegyFile file = scan(SampleSegy::grid(4, 5, 6));
  const survey::Geometry& geometry = file.geometry();
  EXPECT_EQ(geometry.inlines, (survey::LineAxis{10, 2, 4}));
  EXPECT_EQ(geometry.crosslines, (survey::LineAxis{100, 3, 5}));
  EXPECT_EQ(geometry.samples, 6);
  EXPECT_DOUBLE_EQ(geometry.interval, 4);
  EXPECT_EQ(geometry.horizontal_unit, "m");
  EXPECT_TRUE(geometry.assumed.empty());
  const survey::WorldPoint corner = geometry.world_of({3, 4, 5});
  EXPECT_NEAR(corner.x, 1000 + 75 - 40, 1e-9);
  EXPECT_NEAR(corner.y, 2000 + 30 + 80, 1e-9);
  EXPECT_DOUBLE_EQ(corner.z, 20);
  EXPECT_LT(file.report().residual, 1e-6);
  EXPECT_EQ(file.report().live_traces, 20);
  EXPECT_EQ(file.report().missing_bins, 0);
}

TEST(SegyGeometry, AnyTraceOrderGivesTheSameVolume) {
  SampleSegy made = SampleSegy::grid(7, 9, 11);
  const Block expected = read(scan(made), scan(made).geometry().box());
  std::mt19937 random(3);
  for (int turn = 0; turn < 5; ++turn) {
    std::shuffle(made.traces.begin(), made.traces.end(), random);
    const SegyFile file = scan(made);
    const survey::Box box = file.geometry().box();
    EXPECT_EQ(read(file, box).values, expected.values);
    // and blocks of it
    const survey::Box part{{2, 3, 4}, {6, 8, 9}};
    const Block block = read(file, part);
    std::size_t n = 0;
    for (std::int64_t i = 2; i < 6; ++i) {
      for (std::int64_t j = 3; j < 8; ++j) {
        for (std::int64_t k = 4; k < 9; ++k)
          ASSERT_EQ(block.values[n++], static_cast<float>(100 * i + 10 * j + k));
      }
    }
  }
}

TEST(SegyGeometry, ReversedAndNegativeLinesHavePositiveSteps) {
  const SegyFile file = scan(SampleSegy::grid(3, 4, 2, -1, -2, -20, -5));
  EXPECT_EQ(file.geometry().inlines, (survey::LineAxis{-5, 2, 3}));
  EXPECT_EQ(file.geometry().crosslines, (survey::LineAxis{-35, 5, 4}));
  const Block block = read(file, file.geometry().box());
  EXPECT_EQ(block.values.front(), 230.0f);  // the file's last trace
  EXPECT_EQ(block.values.back(), 1.0f);     // its first
  const survey::WorldPoint first = file.geometry().world_of({2, 3, 0});
  EXPECT_NEAR(first.x, 1000, 1e-9);
  EXPECT_NEAR(first.y, 2000, 1e-9);
}

TEST(SegyGeometry, TheStepIsTheGreatestCommonDivisor) {
  SampleSegy made = SampleSegy::grid(4, 4, 2, 10, 6, 100, 4);
  std::erase_if(made.traces, [](const SampleTrace& trace) { return trace.inline_number == 16; });
  for (SampleTrace& trace : made.traces) {
    if (trace.inline_number == 28) trace.inline_number = 25;  // one odd line: gaps 12, 3
  }
  EXPECT_EQ(scan(made).geometry().inlines, (survey::LineAxis{10, 3, 6}));
}

TEST(SegyGeometry, MissingAndDeadTracesAreNotLive) {
  SampleSegy made = SampleSegy::grid(3, 3, 2);
  made.traces[5].halves[29] = 2;  // bin (1, 2)
  made.traces.erase(made.traces.begin() + 4);
  made.traces.push_back({0, 0, 0, 0, {7, 7}, {}, {{29, 2}}});  // padding without line numbers
  const SegyFile file = scan(made);
  EXPECT_EQ(file.geometry().dims(), (survey::Index{3, 3, 2}));
  EXPECT_EQ(file.report().live_traces, 7);
  EXPECT_EQ(file.report().dead_traces, 2);
  EXPECT_EQ(file.report().missing_bins, 2);
  const Block block = read(file, file.geometry().box());
  EXPECT_EQ(block.live, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 0, 1, 1, 1}));
  EXPECT_EQ(block.values[6], 100.0f);
  EXPECT_TRUE(std::isnan(block.values[8]) && std::isnan(block.values[9]));
  EXPECT_TRUE(std::isnan(block.values[10]) && std::isnan(block.values[11]));
  EXPECT_EQ(block.values[12], 200.0f);
}

TEST(SegyGeometry, AFileOfDeadTracesIsTakenAsLive) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  for (SampleTrace& trace : made.traces) trace.halves[29] = 2;
  const SegyFile file = scan(made);
  EXPECT_EQ(file.report().live_traces, 4);
  EXPECT_TRUE(mentions(file.report().warnings, "marked dead"));
  EXPECT_NEAR(file.geometry().map.per_inline_x, 25, 1e-9);
}

TEST(SegyGeometry, OfDoubledTracesTheFirstLiveOneWins) {
  SampleSegy made = SampleSegy::grid(3, 3, 2);
  SampleTrace again = made.traces[4];
  again.values = {-1, -2};
  made.traces.push_back(again);
  made.traces.insert(made.traces.begin(), again);  // now the first of its bin
  made.traces.front().halves[29] = 2;              // but dead
  const SegyFile file = scan(made);
  EXPECT_EQ(file.report().duplicates, 1);
  EXPECT_TRUE(mentions(file.report().warnings, "line numbers of an earlier one"));
  EXPECT_EQ(read(file, file.geometry().box()).values[8], 110.0f);
}

TEST(SegyGeometry, PrestackAndWrongBytesAreRefused) {
  SampleSegy gathers = SampleSegy::grid(3, 3, 2);
  const auto once = gathers.traces;
  for (SampleTrace trace : once) {
    trace.words[37] = 500;
    gathers.traces.push_back(trace);
  }
  EXPECT_EQ(refusal(gathers), ErrorCode::kUnsupported);
  Options options;
  options.inline_byte = 9;
  options.crossline_byte = 21;
  EXPECT_EQ(refusal(SampleSegy::grid(3, 3, 2), options), ErrorCode::kInvalid);
  options.inline_byte = 238;
  EXPECT_EQ(refusal(SampleSegy::grid(3, 3, 2), options), ErrorCode::kUsage);
  options.inline_byte = 0;
  EXPECT_EQ(refusal(SampleSegy::grid(3, 3, 2), options), ErrorCode::kUsage);
}

TEST(SegyGeometry, ScatteredLineNumbersAreRefusedNotAllocated) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  made.traces[3].inline_number = 2147483647;
  made.traces[0].inline_number = -2147483647 - 1;
  EXPECT_EQ(refusal(made), ErrorCode::kInvalid);
  made.traces[3].inline_number = 1000001;
  made.traces[0].inline_number = 1;
  made.traces[3].crossline_number = 1000003;
  EXPECT_EQ(refusal(made), ErrorCode::kInvalid);
}

TEST(SegyGeometry, LineAndCoordinateBytesAsGiven) {
  SampleSegy made = SampleSegy::grid(3, 4, 2);
  for (SampleTrace& trace : made.traces) {
    trace.words = {{9, trace.inline_number}, {21, trace.crossline_number}, {73, trace.x}, {77, trace.y}};
    trace.inline_number = trace.crossline_number = trace.x = trace.y = 0;
  }
  Options options;
  options.inline_byte = 9;
  options.crossline_byte = 21;
  options.x_byte = 73;
  options.y_byte = 77;
  const SegyFile file = scan(made, options);
  EXPECT_EQ(file.geometry().inlines, (survey::LineAxis{10, 2, 3}));
  EXPECT_NEAR(file.geometry().map.per_crossline_y, 20, 1e-9);
}

TEST(SegyGeometry, CoordinateScalarsWorkInDoublePrecision) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  for (SampleTrace& trace : made.traces) {
    trace.x += 650011345;
    trace.halves[71] = -100;
  }
  EXPECT_DOUBLE_EQ(scan(made).geometry().map.origin_x, 6500123.45);
  for (SampleTrace& trace : made.traces) trace.halves[71] = 10;
  EXPECT_DOUBLE_EQ(scan(made).geometry().map.origin_y, 20000);
}

TEST(SegyGeometry, WithoutUsableCoordinatesALocalGridIsAssumedAndSaid) {
  SampleSegy made = SampleSegy::grid(3, 4, 2);
  for (SampleTrace& trace : made.traces) trace.x = trace.y = 0;
  SegyFile file = scan(made);
  EXPECT_TRUE(mentions(file.geometry().assumed, "no X and Y"));
  EXPECT_TRUE(std::isnan(file.report().residual));
  EXPECT_EQ(file.geometry().map, survey::MapView{});
  for (SampleTrace& trace : made.traces) trace.x = trace.y = trace.crossline_number;
  EXPECT_TRUE(mentions(scan(made).geometry().assumed, "do not spread"));
  made = SampleSegy::grid(3, 4, 2);
  for (SampleTrace& trace : made.traces) {
    trace.x /= 10;
    trace.halves[89] = 3;
    trace.y = 50;
  }
  EXPECT_TRUE(mentions(scan(made).geometry().assumed, "angles"));
  for (SampleTrace& trace : made.traces) trace.x *= 100;
  made.traces.front().y += 6;
  EXPECT_TRUE(mentions(scan(made).report().warnings, "says angles"));
}

TEST(SegyGeometry, OneLineHasAMap) {
  const SegyFile inline_only = scan(SampleSegy::grid(1, 5, 2));
  EXPECT_EQ(inline_only.geometry().dims(), (survey::Index{1, 5, 2}));
  EXPECT_NEAR(inline_only.geometry().map.per_crossline_x, -10, 1e-9);
  EXPECT_NEAR(inline_only.geometry().map.per_inline_x, -20, 1e-9);
  EXPECT_TRUE(mentions(inline_only.geometry().assumed, "one inline only"));
  const SegyFile crossline_only = scan(SampleSegy::grid(5, 1, 2));
  EXPECT_NEAR(crossline_only.geometry().map.per_inline_x, 25, 1e-9);
  EXPECT_TRUE(mentions(crossline_only.geometry().assumed, "one crossline only"));
  EXPECT_TRUE(mentions(scan(SampleSegy::grid(1, 1, 2)).geometry().assumed, "one trace only"));
}

TEST(SegyGeometry, ZeroCoordinatesOfSomeTracesDoNotBendTheMap) {
  SampleSegy made = SampleSegy::grid(5, 5, 2);
  made.traces[12].x = made.traces[12].y = 0;
  made.traces[13].x = made.traces[13].y = 0;
  const SegyFile file = scan(made);
  EXPECT_NEAR(file.geometry().map.origin_x, 1000, 1e-9);
  EXPECT_EQ(file.report().without_coordinates, 2);
  EXPECT_TRUE(mentions(file.report().warnings, "left out of the fit"));
}

TEST(SegyGeometry, IntervalsAreReconciled) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  for (SampleTrace& trace : made.traces) trace.halves[117] = 2000;
  SegyFile file = scan(made);
  EXPECT_DOUBLE_EQ(file.geometry().interval, 4);
  EXPECT_TRUE(mentions(file.report().warnings, "sample interval"));
  made.interval_us = 0;
  EXPECT_DOUBLE_EQ(scan(made).geometry().interval, 2);
  for (SampleTrace& trace : made.traces) trace.halves[117] = -5;
  made.interval_us = -2000;
  EXPECT_EQ(refusal(made), ErrorCode::kFormat);
  Options options;
  options.interval = 3;
  EXPECT_DOUBLE_EQ(scan(made, options).geometry().interval, 3);
}

TEST(SegyGeometry, TheDelayIsTheFirstSample) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  for (SampleTrace& trace : made.traces) trace.halves = {{109, 10000}, {215, -10}};
  EXPECT_DOUBLE_EQ(scan(made).geometry().z0, 1000);
  made.traces[2].halves[109] = 20;
  EXPECT_TRUE(mentions(scan(made).report().warnings, "start elsewhere"));
}

TEST(SegyGeometry, DepthAndFeet) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  made.interval_us = 20000;
  made.binary[3255] = made.half(2);
  Options options;
  options.domain = survey::Domain::kDepth;
  options.vertical_unit = survey::VerticalUnit::kFoot;
  options.crs = "EPSG:32040";
  const SegyFile file = scan(made, options);
  EXPECT_DOUBLE_EQ(file.geometry().interval, 20);
  EXPECT_EQ(file.geometry().horizontal_unit, "ft");
  EXPECT_EQ(file.geometry().crs, "EPSG:32040");
}

TEST(SegyGeometry, AnIrregularGridIsReported) {
  SampleSegy made = SampleSegy::grid(4, 4, 2);
  made.traces[7].x += 400;
  made.traces[2].y -= 300;
  made.traces[12].x -= 500;
  const SegyFile file = scan(made);
  EXPECT_GT(file.report().residual, 10);
  EXPECT_TRUE(mentions(file.report().warnings, "off a regular grid"));
}

TEST(SegyGeometry, AFewWildCoordinatesDoNotMoveTheMap) {
  const SampleSegy good = SampleSegy::grid(12, 10, 2);
  const survey::MapView expected = scan(good).geometry().map;
  for (const std::size_t trace : {1u, 57u, 119u}) {
    for (const std::int32_t wild : {2000000000, -60000, 1500}) {
      SampleSegy made = good;
      made.traces[trace].x += wild;
      made.traces[40].y -= wild / 2;
      const SegyFile file = scan(made);
      EXPECT_TRUE(mentions(file.report().warnings, "coordinates of 2 traces lie far off"));
      EXPECT_EQ(file.report().live_traces, 120);
      EXPECT_NEAR(file.geometry().map.origin_x, expected.origin_x, 1e-3);
      EXPECT_NEAR(file.geometry().map.per_inline_x, expected.per_inline_x, 1e-4);
      EXPECT_NEAR(file.geometry().map.per_crossline_y, expected.per_crossline_y, 1e-4);
      EXPECT_LT(file.report().largest_residual, 1e-2);
    }
  }
}

TEST(SegyGeometry, OverflowsAreCountedWhileReading) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  made.format = 6;
  made.traces[3].values = {1e300, -1e300};
  const SegyFile file = scan(made);
  EXPECT_EQ(file.overflowed(), 0);
  EXPECT_EQ(read(file, file.geometry().box()).values.back(), -std::numeric_limits<float>::max());
  EXPECT_EQ(file.overflowed(), 2);
}

TEST(SegyGeometry, LongTracesAreReadByTheirHeaders) {
  const SampleSegy made = SampleSegy::grid(2, 3, 9000);  // above the size where traces are skipped over
  const SegyFile file = scan(made);
  EXPECT_EQ(file.geometry().dims(), (survey::Index{2, 3, 9000}));
  EXPECT_EQ(read(file, {{1, 1, 8000}, {2, 3, 8002}}).values,
            (std::vector<float>{8110.0f, 8111.0f, 8120.0f, 8121.0f}));
}

TEST(SegyGeometry, ACancelledScanStops) {
  const ScratchFolder folder;
  const auto path = folder.file("a.sgy", SampleSegy::grid(3, 3, 2).bytes());
  const JobContext job;
  job.cancel();
  try {
    SegyFile::scan(path, {}, job);
    FAIL() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(SegyGeometry, BlocksOutsideTheSurveyAreABugOfTheCaller) {
  const SegyFile file = scan(SampleSegy::grid(2, 2, 2));
  std::vector<float> values(8);
  std::vector<std::uint8_t> live(4);
  EXPECT_THROW(file.read_block({{0, 0, 0}, {2, 2, 3}}, values, live), Error);
  EXPECT_THROW(file.read_block({{0, 0, 0}, {2, 2, 1}}, values, live), Error);
}

}  // namespace
}  // namespace footwall::formats::segy
