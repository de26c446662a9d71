#include "engine/tasks/doctor/opengl.h"

#include <gtest/gtest.h>

namespace footwall::tasks {
namespace {

TEST(OpenGl, IsFoundOrSaidWhatToInstall) {
  const Finding finding = check_opengl();
  if (finding.verdict == Verdict::kOk) {
    EXPECT_NE(finding.what.find("OpenGL "), std::string::npos) << finding.what;
  } else {
    EXPECT_EQ(finding.verdict, Verdict::kWarning) << "the command line works without it";
    EXPECT_NE(finding.hint.find("libegl1"), std::string::npos);
  }
}

}  // namespace
}  // namespace footwall::tasks
