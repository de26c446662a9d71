#include "app/footwall/console/progress_line.h"

#include <gtest/gtest.h>

namespace footwall::console {
namespace {

using Clock = ProgressLine::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(ProgressLine, AFileGetsALinePerFivePercentOrHalfMinute) {
  const Clock::time_point start{};
  ProgressLine line(false, 80, start);
  EXPECT_EQ(line.update({0.0, "read", ""}, start), "  0 %  read\n");
  EXPECT_EQ(line.update({0.04, "read", ""}, start + seconds(2)), "");
  EXPECT_EQ(line.update({0.5, "read", "5 of 10 MB"}, start + seconds(10)),
            " 50 %  read  5 of 10 MB  10 s left\n");
  EXPECT_EQ(line.update({0.51, "read", ""}, start + seconds(39)), "");
  EXPECT_NE(line.update({0.51, "read", ""}, start + seconds(41)), "");
  EXPECT_EQ(line.end(), "");
}

TEST(ProgressLine, ShowsTheRateThatIsReportedAndTheTimeLeftAtThePaceOfTheLastSeconds) {
  const Clock::time_point start{};
  ProgressLine line(false, 80, start);
  line.update({0.0, "read headers", ""}, start);
  EXPECT_EQ(line.update({0.4, "read headers", "1074 of 1074 MB  900 MB/s"}, start + seconds(4)),
            " 40 %  read headers  1074 of 1074 MB  900 MB/s  6 s left\n");
  // Slower from here on: 3 % a second.
  for (int second = 5; second <= 18; ++second) {
    line.update({0.4 + 0.03 * (second - 4), "write", "5 MB/s"}, start + seconds(second));
  }
  EXPECT_EQ(line.update({0.88, "write", ""}, start + seconds(20)), " 88 %  write  4 s left\n");
  EXPECT_EQ(line.update({1, "write", ""}, start + seconds(24)), "100 %  write\n");
}

TEST(ProgressLine, AJobThatStandsStillPromisesNothing) {
  const Clock::time_point start{};
  ProgressLine line(false, 80, start);
  for (int minute = 0; minute < 5; ++minute) line.update({0.5, "write", ""}, start + minute * seconds(60));
  EXPECT_EQ(line.update({0.5, "write", ""}, start + seconds(360)), " 50 %  write\n");
}

TEST(ProgressLine, ATerminalGetsOneLineThatNeverWraps) {
  const Clock::time_point start{};
  ProgressLine line(true, 40, start);
  const std::string text = line.update({0.5, "voxelize", std::string(100, 'x')}, start + seconds(1));
  EXPECT_EQ(text.substr(0, 5), "\r\x1b[2K");
  EXPECT_LT(text.size(), 5U + 40U);
  EXPECT_EQ(line.update({0.51, "voxelize", ""}, start + seconds(1) + milliseconds(10)), "")
      << "at most ten a second";
  EXPECT_EQ(line.end(), "\r\x1b[2K");
}

TEST(ProgressLine, DurationsAreSpoken) {
  EXPECT_EQ(spoken(seconds(59)), "59 s");
  EXPECT_EQ(spoken(seconds(125)), "2 min 05 s");
  EXPECT_EQ(spoken(seconds(3720)), "1 h 02 min");
}

}  // namespace
}  // namespace footwall::console
