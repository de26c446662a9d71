#include "engine/service/queue/call.h"

#include <gtest/gtest.h>

#include "unit/service/told_call.h"

namespace footwall::service {
namespace {

TEST(Call, TellsEveryNewPhaseButNotEveryStep) {
  ToldCall call("Extract");
  for (int n = 0; n < 1000; ++n) call.context().report(n * 1e-4, "read", std::to_string(n));
  call.context().report(0.5, "voxelize");
  // A thousand steps take less than a tenth of a second, or on a slow machine a few of them.
  ASSERT_GE(call.told.size(), 2U);
  EXPECT_LT(call.told.size(), 500U);
  EXPECT_EQ(call.told.front().phase, "read");
  EXPECT_EQ(call.told.back().phase, "voxelize");
  EXPECT_EQ(call.told.back().fraction, 0.5);
  // What `Status` tells is always the newest.
  EXPECT_EQ(call.state().phase, "voxelize");
}

TEST(Call, IsCancelledByItsContext) {
  ToldCall call("Extract");
  call.context().cancel();
  EXPECT_THROW(call.context().report(0.1, "read"), Error);
}

}  // namespace
}  // namespace footwall::service
