#include "storage/formats/segy/candidates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scratch_folder.h"
#include "segy_sample_file.h"

namespace footwall::formats::segy {
namespace {

std::vector<LineCandidate> candidates_of(const SampleSegy& made) {
  const ScratchFolder folder;
  const detail::ReadOnlyFile file(folder.file("a.sgy", made.bytes()));
  Report report;
  return find_candidates(file, read_layout(file, {}, report));
}

// What processing leaves in other words: sequence numbers, ensembles made of both lines, a copy of a line.
SampleSegy processed(int inlines, int crosslines) {
  SampleSegy made = SampleSegy::grid(inlines, crosslines, 2, 10, 1, 100, 1);
  int sequence = 0;
  for (SampleTrace& trace : made.traces) {
    trace.words[1] = ++sequence;
    trace.words[9] = trace.inline_number;
    trace.words[21] = 1000 * trace.inline_number + trace.crossline_number;
    trace.words[25] = 1 + (sequence - 1) % crosslines;
    trace.words[115] = sequence % 7 * 3;
  }
  return made;
}

TEST(SegyCandidates, SequenceNumbersAndCopiesDoNotWin) {
  const auto found = candidates_of(processed(12, 9));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].preset, "rev1");
  EXPECT_EQ(found[0].inlines, 12);
  EXPECT_EQ(found[0].crosslines, 9);
  EXPECT_NEAR(found[0].hits, 96.0 / 107, 1e-9);
  EXPECT_TRUE(beyond_doubt(found));
  for (const LineCandidate& candidate : found) EXPECT_NE(candidate.inline_word, HeaderWord(9));
}

TEST(SegyCandidates, TheOrderOfTracesDoesNotMatter) {
  SampleSegy made = processed(12, 9);
  std::mt19937 random(4);
  std::shuffle(made.traces.begin(), made.traces.end(), random);
  const auto found = candidates_of(made);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].preset, "rev1");
  EXPECT_EQ(found[0].fill, 1);
  EXPECT_LT(found[0].misfit, 1e-6);
}

TEST(SegyCandidates, ManyTracesAreSampledAtThreePlaces) {
  const auto found = candidates_of(SampleSegy::grid(90, 80, 1, 10, 1, 100, 1));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].inlines, 90);
  EXPECT_EQ(found[0].crosslines, 80);
  EXPECT_EQ(found[0].fill, 1);
}

TEST(SegyCandidates, PrestackTracesHaveNoPair) {
  SampleSegy made = SampleSegy::grid(6, 6, 2);
  const auto once = made.traces;
  for (SampleTrace trace : once) {
    trace.words[37] = 500;
    made.traces.push_back(trace);
  }
  EXPECT_FALSE(beyond_doubt(candidates_of(made)));
}

TEST(SegyCandidates, TwoThatFitAlikeLeaveADoubt) {
  LineCandidate one, other;
  one.score = 0.9;
  other.score = 0.8;
  EXPECT_TRUE(beyond_doubt({one}));
  EXPECT_FALSE(beyond_doubt({one, other}));
  one.misfit = std::nan("");
  EXPECT_FALSE(beyond_doubt({one}));
  EXPECT_FALSE(beyond_doubt({}));
}

}  // namespace
}  // namespace footwall::formats::segy
