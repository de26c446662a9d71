#include "engine/tasks/doctor/folder.h"

#include <gtest/gtest.h>

#include "engine/tasks/doctor/doctor.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

TEST(Folder, ALocalOneIsFitForWorkAndStaysEmpty) {
  const ScratchFolder folder;
  for (const auto& check : {check_names, check_locks, check_rename, check_flush, check_project}) {
    const Finding finding = check(folder.path());
    EXPECT_NE(finding.verdict, Verdict::kFailed) << finding.what;
  }
  std::filesystem::remove(folder / "trial.footwall");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Folder, OneThatIsNotThereEndsTheChecks) {
  const ScratchFolder folder;
  const auto findings = check_folder(folder / "nowhere", {}, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].verdict, Verdict::kFailed);
  EXPECT_NE(findings[0].what.find("nowhere"), std::string::npos);
}

TEST(Folder, AFileIsNoFolder) {
  const ScratchFolder folder;
  folder.file("project", "");
  const auto findings = check_folder(folder / "project", {}, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NE(findings[0].what.find("is no folder"), std::string::npos) << findings[0].what;
}

TEST(Folder, ACancelLeavesNothing) {
  const ScratchFolder folder;
  JobContext* self = nullptr;
  JobContext job([&](const Progress& progress) {
    if (progress.phase == "locks") self->cancel();
  });
  self = &job;
  EXPECT_THROW(check_folder(folder.path(), {}, job), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::tasks
