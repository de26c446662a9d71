#include "engine/tasks/doctor/machine.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "scratch_folder.h"

namespace footwall::tasks {
namespace {

class Machine : public ::testing::Test {
 protected:
  ScratchFolder folder_;
};

TEST_F(Machine, SharedMemoryThatIsNotThereIsAWarning) {
  EXPECT_EQ(check_shared_memory(folder_ / "nowhere").verdict, Verdict::kWarning);
}

TEST_F(Machine, ATemporaryFolderOpenToEverybodyIsAWarning) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("TMPDIR", folder_.path().c_str(), 1);
  EXPECT_EQ(check_temporary_folder().what.find("everybody"), std::string::npos);
  std::filesystem::permissions(folder_.path(), std::filesystem::perms{0777});
  const Finding open = check_temporary_folder();
  if (kept.empty())
    ::unsetenv("TMPDIR");
  else
    ::setenv("TMPDIR", kept.c_str(), 1);
  EXPECT_EQ(open.verdict, Verdict::kWarning);
  EXPECT_NE(open.what.find("everybody"), std::string::npos);
}

TEST_F(Machine, AnEncodingWithoutLettersIsAWarning) {
  const char* before = std::getenv("LC_ALL");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("LC_ALL", "C", 1);
  EXPECT_EQ(check_text().verdict, Verdict::kWarning);
  ::setenv("LC_ALL", "C.UTF-8", 1);
  EXPECT_EQ(check_text().verdict, Verdict::kOk);
  ::setenv("LC_ALL", "xx_YY.nothing", 1);
  EXPECT_EQ(check_text().verdict, Verdict::kWarning);
  if (kept.empty())
    ::unsetenv("LC_ALL");
  else
    ::setenv("LC_ALL", kept.c_str(), 1);
}

TEST_F(Machine, ThisOnesSqliteHasWhatAProjectNeeds) {
  EXPECT_EQ(check_sqlite().verdict, Verdict::kOk);
}

}  // namespace
}  // namespace footwall::tasks
