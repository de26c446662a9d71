#include "storage/project/file_system.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::project {
namespace {

TEST(FileSystemAt, KnowsMemoryAndWhatTheKernelMakesUp) {
  const FileSystemFacts memory = file_system_at("/dev/shm");
  EXPECT_EQ(memory.kind, FileSystem::kLocal);
  EXPECT_EQ(memory.type, "tmpfs");
  EXPECT_TRUE(memory.in_memory);
  EXPECT_NE(file_system_at("/proc").type.find("0x9fa0"), std::string::npos)
      << "a type without a name of ours";
}

TEST(FileSystemAt, SaysWhatIsNotThere) {
  const ScratchFolder folder;
  EXPECT_THROW(file_system_at(folder / "nowhere"), Error);
}

}  // namespace
}  // namespace footwall::project
