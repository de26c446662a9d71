#include "storage/formats/segy/line_steps.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace footwall::formats::segy {
namespace {

// Each line ten times.
std::vector<std::int32_t> traces(std::initializer_list<std::int32_t> lines) {
  std::vector<std::int32_t> out;
  for (const std::int32_t line : lines) out.insert(out.end(), 10, line);
  return out;
}

TEST(SegyLineSteps, AnyOrderAndSign) {
  StepsSoFar steps;
  for (const int line : {-5, 1, -11, 7, -5}) steps.add(line);
  EXPECT_EQ(steps.steps().lowest, -11);
  EXPECT_EQ(steps.steps().highest, 7);
  EXPECT_EQ(steps.steps().step, 6);
  StepsSoFar extremes;
  extremes.add(std::numeric_limits<std::int32_t>::min());
  extremes.add(std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(extremes.steps().count(), 2);
}

TEST(SegyLineSteps, OneOddLineIsLeftOutOfTheBody) {
  auto lines = traces({100, 104, 108, 112, 116, 120, 124, 128});
  lines.insert(lines.begin() + 35, 109);  // between, off the multiples of 4
  LineSteps body = main_steps_of(lines);
  EXPECT_EQ(body.lowest, 100);
  EXPECT_EQ(body.highest, 128);
  EXPECT_EQ(body.step, 4);
  lines = traces({100, 104, 108, 112, 116, 120, 124, 128});
  lines.push_back(2000000000);  // far away
  body = main_steps_of(lines);
  EXPECT_EQ(body.highest, 128);
  EXPECT_EQ(body.count(), 8);
}

TEST(SegyLineSteps, WhatIsNotRareIsNotLeftOut) {
  const auto two_blocks = traces({1, 2, 3, 4, 901, 902, 903});
  EXPECT_EQ(main_steps_of(two_blocks).count(), 903);
  const std::vector<std::int32_t> few{1, 2, 3, 5000};
  EXPECT_EQ(main_steps_of(few).highest, 5000);
  const std::vector<std::int32_t> one(20, 7);
  EXPECT_EQ(main_steps_of(one).count(), 1);
}

}  // namespace
}  // namespace footwall::formats::segy
