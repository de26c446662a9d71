#include "engine/session/keeper.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "scratch_folder.h"

namespace footwall::session {
namespace {

constexpr int kPatienceMs = 20'000;

// Waits for the end of a process that may not be a child.
bool ends(pid_t process) {
  const auto descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) return true;
  pollfd wanted{descriptor, POLLIN, 0};
  const bool ended = poll(&wanted, 1, kPatienceMs) == 1;
  close(descriptor);
  return ended;
}

// The fake engine's program as the keeper of a shell that says its number, and that of a child of its own.
class Keeper : public testing::Test {
 protected:
  Keeper() {
    std::filesystem::create_directory(folder / "belongs");
    folder.file("belongs/socket", "");
    folder.file("own", "{\"token\": \"secret\"}");
    folder.file("lock", "");
    belongings.folders = {folder / "belongs"};
    belongings.secret_file = folder / "own";
    belongings.lock = folder / "lock";
    setenv("KEEPER_TEST_SECRET", "secret", 1);
  }
  ~Keeper() override {
    unsetenv("KEEPER_TEST_SECRET");
    if (in != nullptr) fclose(in);
  }

  // An owner, which starts a keeper and waits for its own end.
  void start(const std::string& script) {
    int output[2];
    ASSERT_EQ(pipe(output), 0);
    owner = fork();
    if (owner == 0) {
      std::vector<std::string> words =
          kept_command(FAKE_ENGINE, belongings, "KEEPER_TEST_SECRET", {"/bin/sh", "-c", script});
      std::vector<char*> pointers;
      for (std::string& word : words) pointers.push_back(word.data());
      pointers.push_back(nullptr);
      const pid_t keeper = fork();
      if (keeper == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        dup2(output[1], STDOUT_FILENO);
        close(output[0]);
        close(output[1]);
        execv(pointers.front(), pointers.data());
        _exit(127);
      }
      close(output[1]);
      int status = 0;
      waitpid(keeper, &status, 0);
      _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 99);
    }
    close(output[1]);
    if (in != nullptr) fclose(in);
    in = fdopen(output[0], "r");
  }
  pid_t number() {
    long value = 0;
    EXPECT_EQ(fscanf(in, "%ld", &value), 1);
    return static_cast<pid_t>(value);
  }
  int status_of_owner() const {
    int status = 0;
    waitpid(owner, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ScratchFolder folder;
  Belongings belongings;
  pid_t owner = -1;
  FILE* in = nullptr;
};

TEST_F(Keeper, EndsAsItsCommandDoesAndKeepsWhatIsTheOwners) {
  start("exit 7");
  EXPECT_EQ(status_of_owner(), 7);
  EXPECT_TRUE(std::filesystem::exists(folder / "belongs"));
  EXPECT_TRUE(std::filesystem::exists(folder / "own"));
  EXPECT_TRUE(std::filesystem::exists(folder / "lock"));
  start("kill -9 $$");
  EXPECT_EQ(status_of_owner(), 128 + SIGKILL);
}

TEST_F(Keeper, EndsWhatItsCommandLeaves) {
  start("setsid sleep 1000 & echo $!; exit 0");
  const pid_t left = number();
  EXPECT_EQ(status_of_owner(), 0);
  EXPECT_TRUE(ends(left));
}

TEST_F(Keeper, TakesAwayWhatAKilledOwnerCouldNot) {
  // It does not heed SIGTERM, and so is killed.
  start("trap '' TERM; setsid sleep 1000 & echo $!; echo $$; wait; sleep 1000");
  const pid_t child = number();
  const pid_t command = number();
  kill(owner, SIGKILL);
  status_of_owner();
  EXPECT_TRUE(ends(command));
  EXPECT_TRUE(ends(child));
  while (fgetc(in) != EOF) {
  }  // until the keeper, the last that has the pipe, has ended
  EXPECT_FALSE(std::filesystem::exists(folder / "belongs"));
  EXPECT_FALSE(std::filesystem::exists(folder / "own"));
  EXPECT_FALSE(std::filesystem::exists(folder / "lock"));
}

TEST_F(Keeper, LeavesWhatIsAnothersByThen) {
  start("echo $$; sleep 1000");
  const pid_t command = number();
  // The next owner has written its file, and holds the lock.
  folder.file("own", "{\"token\": \"another\"}");
  const int lock = open((folder / "lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  kill(owner, SIGKILL);
  status_of_owner();
  EXPECT_TRUE(ends(command));
  while (fgetc(in) != EOF) {
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "belongs"));
  EXPECT_TRUE(std::filesystem::exists(folder / "own"));
  EXPECT_TRUE(std::filesystem::exists(folder / "lock"));
  close(lock);
}

}  // namespace
}  // namespace footwall::session
