// Line numbers found where they are, odd ones left out, and what `info` says of files that import refuses.
#include "storage/formats/segy/survey_scan.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "scratch_folder.h"
#include "segy_sample_file.h"

namespace footwall::formats::segy {
namespace {

Inspection look(const SampleSegy& made, const Options& options = {}) {
  const ScratchFolder folder;
  return inspect(folder.file("a.sgy", made.bytes()), options, {});
}

bool mentions(const std::vector<std::string>& lines, const std::string& what) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(what) != std::string::npos; });
}

// Moves the words of a grid to other bytes and leaves nothing at the usual ones.
SampleSegy moved(SampleSegy made, int inline_byte, int crossline_byte, int x_byte, int y_byte) {
  for (SampleTrace& trace : made.traces) {
    trace.words = {{inline_byte, trace.inline_number},
                   {crossline_byte, trace.crossline_number},
                   {x_byte, trace.x},
                   {y_byte, trace.y}};
    // The grid's own places are written first, so that the words win where they coincide.
    trace.inline_number = trace.crossline_number = trace.x = trace.y = 0;
  }
  return made;
}

TEST(SegySurveyScan, LinesElsewhereAreFoundAndSaidToBeAssumed) {
  const int places[][4] = {{5, 21, 73, 77}, {9, 13, 81, 85}, {213, 217, 181, 185}, {181, 185, 73, 77}};
  for (const auto& [a, b, x, y] : places) {
    SCOPED_TRACE(a);
    const Inspection found = look(moved(SampleSegy::grid(6, 8, 2), a, b, x, y));
    ASSERT_TRUE(found.geometry) << found.refusal->message();
    EXPECT_EQ(found.geometry->inlines, (survey::LineAxis{10, 2, 6}));
    EXPECT_EQ(found.geometry->crosslines, (survey::LineAxis{100, 3, 8}));
    EXPECT_EQ(found.report.x_word, HeaderWord(x));
    EXPECT_LT(found.report.largest_residual, 1e-3);
    EXPECT_TRUE(mentions(found.geometry->assumed, "the usual words make no grid"));
    ASSERT_FALSE(found.candidates.empty());
    EXPECT_EQ(found.candidates[0].inline_word, HeaderWord(a));
    EXPECT_LE(found.candidates[0].misfit, 1e-6);
    EXPECT_EQ(found.candidates[0].fill, 1);
  }
}

TEST(SegySurveyScan, FloatWordsAreFoundAndScalarsDoNotApplyToThem) {
  SampleSegy made = moved(SampleSegy::grid(6, 8, 2), 9, 13, 1, 1);
  for (SampleTrace& trace : made.traces) {
    const float x = 1000.25f + static_cast<float>(25 * trace.words[9]),
                y = 50.0f * static_cast<float>(trace.words[13]);
    trace.words.erase(1);
    trace.words[81] = std::bit_cast<std::int32_t>(x);
    trace.words[85] = std::bit_cast<std::int32_t>(y);
    trace.halves[71] = -100;
  }
  const Inspection found = look(made);
  ASSERT_TRUE(found.geometry);
  EXPECT_EQ(found.report.x_word, HeaderWord(81, WordType::kIeee));
  EXPECT_EQ(found.candidates[0].preset, "float_xy");
  EXPECT_DOUBLE_EQ(found.geometry->map.origin_x, 1000.25 + 250);
  Options options;
  options.preset = "float_xy";
  options.coordinate_scalar = 10;
  EXPECT_DOUBLE_EQ(look(made, options).geometry->map.origin_x, 12502.5);
}

TEST(SegySurveyScan, WithoutCoordinatesNothingIsTakenButCandidatesAreNamed) {
  const Inspection found = look(moved(SampleSegy::grid(6, 8, 2), 213, 217, 233, 233));
  ASSERT_TRUE(found.refusal);
  EXPECT_EQ(found.refusal->code(), ErrorCode::kInvalid);
  EXPECT_NE(found.refusal->hint().find("--preset unassigned (6 x 8 lines)"), std::string::npos)
      << found.refusal->hint();
  EXPECT_FALSE(found.geometry);
  EXPECT_EQ(found.report.traces, 48);
}

TEST(SegySurveyScan, LinesThatAreGivenAreNeverReplaced) {
  Options options;
  options.inline_byte = 9;
  const Inspection found = look(moved(SampleSegy::grid(6, 8, 2), 5, 21, 73, 77), options);
  ASSERT_TRUE(found.refusal);
  EXPECT_EQ(found.report.inline_word, HeaderWord(9));
}

TEST(SegySurveyScan, ALineByItsEnsembleNumbersOrItsOrder) {
  SampleSegy made = moved(SampleSegy::grid(1, 20, 2), 237, 21, 181, 185);
  Inspection found = look(made);
  ASSERT_TRUE(found.geometry);
  EXPECT_EQ(found.geometry->crosslines, (survey::LineAxis{100, 3, 20}));
  EXPECT_EQ(found.candidates[0].preset, "line_2d");
  for (SampleTrace& trace : made.traces) trace.words.erase(21);
  found = look(made);
  ASSERT_TRUE(found.geometry);
  EXPECT_EQ(found.geometry->crosslines, (survey::LineAxis{1, 1, 20}));
  EXPECT_EQ(found.report.crossline_word, kOrderWord);
  for (SampleTrace& trace : made.traces)
    trace.words[37] = 100 * static_cast<int>(&trace - made.traces.data());
  EXPECT_TRUE(look(made).refusal);  // several offsets: a gather, no line
}

TEST(SegySurveyScan, OddLineNumbersAreLeftOutAndCounted) {
  SampleSegy made = SampleSegy::grid(10, 10, 2);
  made.traces[55].inline_number = 1999999999;
  Inspection found = look(made);
  ASSERT_TRUE(found.geometry);
  EXPECT_EQ(found.geometry->inlines, (survey::LineAxis{10, 2, 10}));
  EXPECT_EQ(found.report.odd_traces, 1);
  EXPECT_EQ(found.report.missing_bins, 1);
  EXPECT_TRUE(mentions(found.report.warnings, "inline 1999999999"));
  made.traces[55].inline_number = 21;  // between lines that go in steps of 2
  found = look(made);
  EXPECT_EQ(found.geometry->inlines, (survey::LineAxis{10, 2, 10}));
  EXPECT_EQ(found.report.odd_traces, 1);
}

TEST(SegySurveyScan, GapsAreSummedUpByInline) {
  SampleSegy made = SampleSegy::grid(5, 6, 2);
  std::erase_if(made.traces, [](const SampleTrace& trace) {
    return trace.inline_number == 14 || (trace.inline_number == 12 && trace.crossline_number >= 109) ||
           (trace.inline_number == 16 && (trace.crossline_number == 100 || trace.crossline_number == 106));
  });
  const Report report = look(made).report;
  EXPECT_EQ(report.missing_bins, 6 + 3 + 2);
  EXPECT_EQ(report.gaps.lines, 2);
  EXPECT_EQ(report.gaps.whole_lines, 1);
  ASSERT_EQ(report.gaps.listed.size(), 3u);
  EXPECT_EQ(report.gaps.listed[0].first, 109);
  EXPECT_EQ(report.gaps.listed[0].last, 115);
  EXPECT_EQ(report.gaps.listed[1].missing, 6);
  EXPECT_EQ(report.gaps.listed[2].first, 100);
  EXPECT_EQ(report.gaps.listed[2].last, 106);
}

TEST(SegySurveyScan, TheLargestResidualIsTheFarthestTraces) {
  SampleSegy made = SampleSegy::grid(20, 20, 2);
  made.traces[210].x += 8;
  const Report report = look(made).report;
  EXPECT_NEAR(report.largest_residual, 8, 0.1);
  EXPECT_LT(report.residual, 0.5);
}

TEST(SegySurveyScan, ScalarsThatDifferAreMendedWhereOneMakesAGrid) {
  SampleSegy made = SampleSegy::grid(6, 6, 2);
  for (SampleTrace& trace : made.traces) trace.halves[71] = -10;
  made.traces[0].halves[71] = 1;
  made.traces[7].halves[71] = 0;
  const Inspection found = look(made);
  EXPECT_LT(found.report.largest_residual, 1e-3);
  EXPECT_EQ(found.report.coordinate_scalar, -10);
  EXPECT_DOUBLE_EQ(found.geometry->map.origin_x, 100);
  EXPECT_TRUE(mentions(found.report.warnings, "scalars differ"));
  // Scalars that differ with reason stay as they are.
  made.traces[0].x *= -1;
  for (std::size_t n = 0; n < made.traces.size(); ++n) {
    made.traces[n].halves[71] = n % 2 == 0 ? -10 : -100;
    if (n % 2 == 1) {
      made.traces[n].x *= 10;
      made.traces[n].y *= 10;
    }
  }
  made.traces[0].x *= -1;
  const Inspection legal = look(made);
  EXPECT_LT(legal.report.largest_residual, 1e-3);
  EXPECT_FALSE(mentions(legal.report.warnings, "scalars differ"));
}

TEST(SegySurveyScan, IntervalsThatConflictAreListed) {
  SampleSegy made = SampleSegy::grid(2, 2, 2);
  for (SampleTrace& trace : made.traces) trace.halves[117] = 2000;
  const Report report = look(made).report;
  ASSERT_EQ(report.conflicts.size(), 1u);
  EXPECT_EQ(report.conflicts[0].binary_header, 4000);
  EXPECT_EQ(report.conflicts[0].trace_headers, 2000);
  EXPECT_EQ(report.conflicts[0].traces, 4);
  EXPECT_EQ(report.conflicts[0].used, 4000);
}

TEST(SegySurveyScan, RefusedFilesStillHaveTheirReport) {
  SampleSegy made = SampleSegy::grid(3, 3, 2);
  made.format = 4;
  Inspection found = look(made);
  EXPECT_EQ(found.refusal->code(), ErrorCode::kUnsupported);
  EXPECT_EQ(found.report.format, 4);
  EXPECT_EQ(found.report.traces, 9);
  made = SampleSegy::grid(3, 3, 2);
  made.interval_us = -4;
  found = look(made);
  EXPECT_NE(found.refusal->hint().find("--interval"), std::string::npos);
  EXPECT_EQ(found.inlines, (survey::LineAxis{10, 2, 3}));
  made = SampleSegy::grid(3, 3, 2);
  made.traces.clear();
  made.samples = 5;
  made.text = std::string(300, 'C');
  const ScratchFolder folder;
  const auto path = folder.file("a.sgy", made.bytes());
  EXPECT_TRUE(looks_like_segy(path));
  EXPECT_EQ(inspect(path, {}, {}).refusal->code(), ErrorCode::kFormat);
}

TEST(SegySurveyScan, TheAdditionalHeaderHasCoordinatesInDouble) {
  SampleSegy made = SampleSegy::grid(3, 4, 60);
  made.binary[3501] = std::string("\x02\x01", 2);
  made.binary[3507] = made.half(1);
  std::string bytes = made.bytes();
  std::string file = bytes.substr(0, 3600);
  for (int n = 0; n < 12; ++n) {
    std::string extra(240, '\0');
    const auto put = [&](int byte, double value) {
      const std::string number = SampleSegy::number(std::bit_cast<std::uint64_t>(value), 8, false);
      SampleSegy::put(extra, byte, number);
    };
    put(161, 500000.125 + 25 * (n / 4));
    put(169, 6000000.25 + 12.5 * (n % 4));
    SampleSegy::put(extra, 233, "SEG00001");
    const std::string trace = bytes.substr(static_cast<std::size_t>(3600 + n * 480), 480);
    file += trace.substr(0, 240) + extra + trace.substr(240);
  }
  const ScratchFolder folder;
  const Inspection found = inspect(folder.file("a.sgy", file), {}, {});
  ASSERT_TRUE(found.geometry) << found.refusal->message();
  EXPECT_DOUBLE_EQ(found.geometry->map.origin_x, 500000.125);
  EXPECT_NEAR(found.geometry->map.per_crossline_y, 12.5, 1e-9);
  EXPECT_EQ(text_of(found.report.x_word), "401:float64");
}

}  // namespace
}  // namespace footwall::formats::segy
