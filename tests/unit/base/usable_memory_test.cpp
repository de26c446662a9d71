#include "storage/base/usable_memory.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"

namespace footwall {
namespace {

class UsableMemoryOf : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::int64_t usable() const { return usable_memory(folder_.path()).bytes; }
  ScratchFolder folder_;
};

TEST_F(UsableMemoryOf, AJobIsWhatTheTightestControlGroupLeaves) {
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

TEST_F(UsableMemoryOf, OldControlGroupsCountToo) {
  put("proc/meminfo", "MemAvailable:  5000 kB\n");
  put("proc/self/cgroup", "4:memory:/docker/abc\n3:cpu:/\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(usable(), 5000 * 1024);
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000\n");
  put("sys/fs/cgroup/memory/memory.usage_in_bytes", "2000000\n");
  EXPECT_EQ(usable(), 0);
}

}  // namespace
}  // namespace footwall
