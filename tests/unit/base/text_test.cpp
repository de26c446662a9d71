#include "storage/base/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace footwall::text {
namespace {

TEST(Text, WordsAndSplitKeepWhatUsersMean) {
  EXPECT_EQ(words(" a\tb  c\r\n"), (std::vector<std::string_view>{"a", "b", "c"}));
  EXPECT_TRUE(words("  ").empty());
  EXPECT_EQ(split("1, ,3", ','), (std::vector<std::string_view>{"1", "", "3"}));
}

TEST(Text, NumbersMustFillTheWholeWord) {
  EXPECT_EQ(number("+1.5e3"), 1500.0);
  EXPECT_EQ(integer("-12"), -12);
  for (const char* bad : {"", "1x", "+", "1,5", "0x10"}) EXPECT_FALSE(number(bad).has_value()) << bad;
}

TEST(Text, ShortestReadsBackAsTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3, 6084991.7, 1e-300, -0.0})
    EXPECT_EQ(number(shortest(value)), value);
  EXPECT_EQ(shortest(std::numeric_limits<double>::quiet_NaN()), "");
}

}  // namespace
}  // namespace footwall::text
