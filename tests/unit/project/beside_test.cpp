// Several connections of one program to one project.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <thread>

#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

class Beside : public ProjectFolder {
 protected:
  // Whether another process finds a POSIX lock on the project's file: asked by a child, since locks do not go
  // over to children and a process does not see its own. What keeps other programs from taking SQLite's log
  // away.
  bool is_locked_for_others() const {
    const pid_t child = ::fork();
    if (child == 0) {
      const int file = ::open(path_.c_str(), O_RDWR);
      struct flock lock {};
      lock.l_type = F_WRLCK;
      lock.l_whence = SEEK_SET;
      const bool asked = file >= 0 && ::fcntl(file, F_GETLK, &lock) == 0;
      ::_exit(!asked ? 2 : lock.l_type == F_UNLCK ? 0 : 1);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2);
    return WEXITSTATUS(status) == 1;
  }
};

TEST_F(Beside, SeesWhatIsCommittedAndWritesUnderTheSameLock) {
  auto project = Project::create(path_, small_survey());
  project.edit("one", [](Interpretation& it) { it.add_fault("One"); });
  auto beside = project.beside();
  EXPECT_FALSE(beside.read_only());
  ASSERT_EQ(beside.faults().size(), 1U);
  std::thread([&] { beside.edit("two", [](Interpretation& it) { it.add_fault("Two"); }); }).join();
  ASSERT_EQ(project.faults().size(), 2U);
  EXPECT_EQ(project.history().back().name, "two");
  EXPECT_EQ(project.undo(), "two");
  EXPECT_EQ(beside.faults().size(), 1U);
  beside.close();
  project.edit("three", [](Interpretation& it) { it.add_fault("Three"); });  // still the writer
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite); }).code(), ErrorCode::kHeld);
}

// Longer than SQLite's own patience of 5 s.
TEST_F(Beside, WaitsUntilTheOtherHasWritten) {
  auto project = Project::create(path_, small_survey());
  auto beside = project.beside();
  std::promise<void> begun;
  std::thread slow([&] {
    beside.edit("slow", [&](Interpretation& it) {
      begun.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(5500));
      it.add_fault("Slow");
    });
  });
  begun.get_future().wait();
  project.edit("gesture", [](Interpretation& it) { it.add_fault("Gesture"); });
  slow.join();
  ASSERT_EQ(project.history().size(), 2U);
  EXPECT_EQ(project.history().back().name, "gesture");
}

TEST_F(Beside, LeavesTheLocksOfTheFirstWhereTheyAre) {
  auto project = Project::create(path_, small_survey());
  project.edit("one", [](Interpretation& it) { it.add_fault("One"); });
  ASSERT_TRUE(is_locked_for_others());
  { const auto beside = project.beside(); }
  EXPECT_TRUE(is_locked_for_others());
  {
    auto beside = project.beside();
    beside.edit("two", [](Interpretation& it) { it.add_fault("Two"); });
  }
  EXPECT_TRUE(is_locked_for_others());
}

// Why beside() is there. Where this fails, open() has learnt to leave the file alone, and its comment may go.
TEST_F(Beside, OpeningTheFileTwiceLosesThem) {
  auto project = Project::create(path_, small_survey());
  project.edit("one", [](Interpretation& it) { it.add_fault("One"); });
  ASSERT_TRUE(is_locked_for_others());
  { const auto again = Project::open(path_, OpenMode::kRead); }
  EXPECT_FALSE(is_locked_for_others());
}

TEST_F(Beside, TheLastOneLeavesOneFile) {
  auto project = Project::create(path_, small_survey());
  EXPECT_TRUE(project.faults().empty());  // reads, and so has the log open
  {
    auto beside = project.beside();
    beside.edit("one", [](Interpretation& it) { it.add_fault("One"); });
  }
  EXPECT_TRUE(std::filesystem::exists(path_.string() + "-wal"));
  project.close();
  EXPECT_FALSE(std::filesystem::exists(path_.string() + "-wal"));
  EXPECT_FALSE(std::filesystem::exists(path_.string() + ".lock"));
  EXPECT_EQ(Project::open(path_, OpenMode::kRead).faults().size(), 1U);
}

TEST_F(Beside, AReaderStaysAReader) {
  Project::create(path_, small_survey()).close();
  const auto project = Project::open(path_, OpenMode::kRead);
  auto beside = project.beside();
  EXPECT_TRUE(beside.read_only());
  EXPECT_EQ(error_of([&] { beside.edit("no", [](Interpretation& it) { it.add_fault("No"); }); }).code(),
            ErrorCode::kInvalid);
}

TEST_F(Beside, AnEditThatFailsLeavesNothingForTheOther) {
  auto project = Project::create(path_, small_survey());
  auto beside = project.beside();
  EXPECT_THROW(beside.edit("half",
                           [](Interpretation& it) {
                             it.add_fault("Half");
                             throw Error(ErrorCode::kCancelled, "cancelled");
                           }),
               Error);
  EXPECT_TRUE(project.faults().empty());
  EXPECT_TRUE(project.history().empty());
}

}  // namespace
}  // namespace footwall::project
