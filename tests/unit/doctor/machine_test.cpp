#include "engine/tasks/doctor/machine.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>

#include "scratch_folder.h"

namespace footwall::tasks {
namespace {

class Machine : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::int64_t usable() const { return usable_memory(folder_.path()).bytes; }
  ScratchFolder folder_;
};

TEST_F(Machine, MemoryIsWhatTheTightestControlGroupLeaves) {
  put("proc/meminfo", "MemTotal:  8000 kB\nMemAvailable:  5000 kB\n");
  EXPECT_EQ(usable(), 5000 * 1024);
  EXPECT_EQ(usable_memory(folder_.path()).machine, 8000 * 1024);
  put("proc/self/cgroup", "0::/job/step\n");
  put("sys/fs/cgroup/job/step/memory.max", "max\n");
  EXPECT_EQ(usable(), 5000 * 1024) << "no limit";
  put("sys/fs/cgroup/job/memory.max", "4000000\n");
  put("sys/fs/cgroup/job/memory.current", "3000000\n");
  put("sys/fs/cgroup/job/memory.stat", "anon 5\ninactive_file 500000\n");
  EXPECT_EQ(usable(), 1'500'000) << "the limit of the group around, less what is used for more than a cache";
  put("sys/fs/cgroup/memory.max", "100\n");
  EXPECT_EQ(usable(), 100) << "a container's own, whose path is not there";
}

TEST_F(Machine, OldControlGroupsCountToo) {
  put("proc/meminfo", "MemAvailable:  5000 kB\n");
  put("proc/self/cgroup", "4:memory:/docker/abc\n3:cpu:/\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(usable(), 5000 * 1024);
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000\n");
  put("sys/fs/cgroup/memory/memory.usage_in_bytes", "2000000\n");
  EXPECT_EQ(usable(), 0);
}

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
