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
