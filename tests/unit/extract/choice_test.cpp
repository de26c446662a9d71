#include "engine/extract/choice.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

TEST(Choice, SplitsNameAndParameters) {
  EXPECT_EQ(parse_choice("push"), (Choice{"push", {}}));
  EXPECT_EQ(parse_choice("local=0,cache"), (Choice{"local", {"0", "cache"}}));
  EXPECT_EQ(parse_choice("local=0,cache").text(), "local=0,cache");
  EXPECT_EQ(parse_choice("block="), (Choice{"block", {""}}));
}

TEST(Choice, TakesNumbersInTheirRangeOnly) {
  const Choice choice = parse_choice("manhattan=5.5,2");
  EXPECT_EQ(choice.number(0, "delta", 0, 0, 100), 5.5);
  EXPECT_EQ(choice.whole(1, "tau", 9, 1, 100), 2);
  EXPECT_EQ(choice.whole(2, "tau", 9, 1, 100), 9);
  EXPECT_THROW(choice.whole(0, "tau", 9, 1, 100), Error);
  EXPECT_THROW(choice.number(0, "delta", 0, 0, 5), Error);
  EXPECT_THROW(parse_choice("manhattan=nan").number(0, "delta", 0, 0, 5), Error);
  EXPECT_THROW(parse_choice("manhattan=").number(0, "delta", 0, 0, 5), Error);
  EXPECT_THROW(choice.takes_at_most(1), Error);
  EXPECT_NO_THROW(choice.takes_at_most(2));
}

}  // namespace
}  // namespace footwall::extract
