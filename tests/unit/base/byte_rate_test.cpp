#include "storage/base/byte_rate.h"

#include <gtest/gtest.h>

namespace footwall {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(ByteRate, SaysHowMuchAndHowFast) {
  const ByteRate::Clock::time_point start{};
  ByteRate rate(1'000'000'000, start);
  EXPECT_EQ(rate.text(0, start), "0 of 1000 MB");
  EXPECT_EQ(rate.text(400'000'000, start + milliseconds(500)), "400 of 1000 MB  800 MB/s");
}

TEST(ByteRate, ADiskThatBecomesSlowShowsAndTheEndTellsTheWhole) {
  const ByteRate::Clock::time_point start{};
  ByteRate rate(1'000'000'000, start);
  rate.text(800'000'000, start + seconds(2));
  EXPECT_EQ(rate.text(820'000'000, start + seconds(4)), "820 of 1000 MB  10 MB/s");
  EXPECT_EQ(rate.text(820'000'000, start + seconds(6)), "820 of 1000 MB  0 MB/s");
  EXPECT_EQ(rate.text(1'000'000'000, start + seconds(10)), "1000 of 1000 MB  100 MB/s");
}

}  // namespace
}  // namespace footwall
