#include "storage/base/job_context.h"

#include <gtest/gtest.h>

#include <vector>

#include "storage/base/error.h"

namespace footwall {
namespace {

TEST(JobContext, PartsFillTheirShareAndNeverFallBack) {
  std::vector<double> seen;
  const JobContext job([&](const Progress& p) { seen.push_back(p.fraction); });
  job.part(0.0, 0.5).report(1.0, "first");
  job.part(0.5, 1.0).part(0.0, 0.5).report(1.0, "second");
  job.report(0.1, "late");
  EXPECT_EQ(seen, (std::vector<double>{0.5, 0.75, 0.75}));
}

TEST(JobContext, CancelReachesEveryPart) {
  const JobContext job;
  const JobContext part = job.part(0.2, 0.4);
  EXPECT_NO_THROW(part.check());
  job.cancel();
  EXPECT_TRUE(part.cancelled());
  try {
    part.report(0.5, "work");
    FAIL() << "a cancelled job must throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

}  // namespace
}  // namespace footwall
