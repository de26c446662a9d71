#include "storage/base/partial_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall {
namespace {

class PartialFileTest : public ::testing::Test {
 protected:
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
  ScratchFolder folder_;
};

TEST_F(PartialFileTest, TakesItsNameOnlyWhenCommitted) {
  const auto path = folder_ / "whole.txt";
  {
    PartialFile file(path);
    std::ofstream(file.path()) << "half";
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_EQ(entries(), 0U) << "an abandoned file must leave nothing";
  write_whole_file(path, "whole");
  EXPECT_EQ(read_whole_file(path, 100), "whole");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(PartialFileTest, WhatAKilledProgramLeftOfOneNameCanBeRemoved) {
  PartialFile other(folder_ / "another");
  const PartialFile file(folder_ / "one");
  std::ofstream(other.path()) << "still written";
  std::ofstream(file.path()) << "half";
  std::ofstream(folder_ / "one") << "whole";
  remove_partial_files_of(folder_ / "one");
  EXPECT_FALSE(std::filesystem::exists(file.path()));
  EXPECT_TRUE(std::filesystem::exists(other.path()));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "one"));
  EXPECT_NO_THROW(remove_partial_files_of(folder_ / "no" / "file"));
}

TEST_F(PartialFileTest, RefusesAFolderThatIsNotThereAndAFileThatIsTooLarge) {
  EXPECT_THROW(PartialFile(folder_ / "no" / "file"), Error);
  write_whole_file(folder_ / "ten", "0123456789");
  EXPECT_THROW(read_whole_file(folder_ / "ten", 9), Error);
  EXPECT_THROW(read_whole_file(folder_ / "none", 9), Error);
}

}  // namespace
}  // namespace footwall
