#include "engine/tasks/doctor/finding.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

TEST(Checkup, WhatACheckThrowsIsAFailedRow) {
  const JobContext job;
  Checkup checkup(job, 3);
  EXPECT_TRUE(checkup.run("one", [] { return warning("w", "h"); }));
  EXPECT_FALSE(
      checkup.run("two", []() -> Finding { throw Error(ErrorCode::kIo, "disk gone", "plug it in"); }));
  EXPECT_FALSE(checkup.run("three", []() -> Finding { throw std::runtime_error("odd"); }));
  const auto findings = std::move(checkup).findings();
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].name, "one");
  EXPECT_EQ(findings[1].verdict, Verdict::kFailed);
  EXPECT_EQ(findings[1].what + findings[1].hint, "disk goneplug it in");
  EXPECT_EQ(findings[2].what, "odd");
}

TEST(Checkup, ACancelEndsIt) {
  const JobContext job;
  Checkup checkup(job, 1);
  EXPECT_THROW(checkup.run("one",
                           [&]() -> Finding {
                             job.cancel();
                             job.check();
                             return ok("never");
                           }),
               Error);
}

}  // namespace
}  // namespace footwall::tasks
