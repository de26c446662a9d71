#include "app/footwall/console/console.h"

#include <gtest/gtest.h>

#include <csignal>

namespace footwall::console {
namespace {

TEST(Console, ErrorsHaveTheExitStatusThatScriptsRelyOn) {
  EXPECT_EQ(exit_status(ErrorCode::kUsage), 2);
  EXPECT_EQ(exit_status(ErrorCode::kCancelled), 130);
  EXPECT_EQ(exit_status(ErrorCode::kCorrupt), 1);
  const Json json = error_json(Error(ErrorCode::kHeld, "held", "wait"));
  EXPECT_EQ(json["error"]["code"], "held");
  EXPECT_EQ(json["error"]["message"], "held");
  EXPECT_EQ(json["error"]["hint"], "wait");
}

TEST(Console, CtrlCCancelsTheJobAndNothingElse) {
  Console console(true);
  EXPECT_FALSE(console.job().cancelled());
  std::raise(SIGINT);
  EXPECT_TRUE(console.job().cancelled());
}

}  // namespace
}  // namespace footwall::console
