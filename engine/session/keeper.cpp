#include "engine/session/keeper.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::session {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kWord = "keep";
constexpr std::size_t kLongestFile = std::size_t{1} << 18;
constexpr std::chrono::seconds kTimeToEnd{2};
// How soon it looks again for what is left while things end.
constexpr timespec kPause{0, 20'000'000};
// Until the lock of an owner that was killed is let go.
constexpr int kLockLooks = 50;
constexpr std::chrono::milliseconds kLockLook{10};
constexpr int kOwnerLooks = 200;
constexpr std::uint64_t kExiting = 4;  // PF_EXITING among a thread's flags in /proc/N/stat

struct Orders {
  pid_t owner = 0;
  Belongings belongings;
  std::string secret_variable;
  std::vector<char*> command;  // ends with a null
};

Orders orders_from(std::span<char* const> arguments) {
  Orders orders;
  std::size_t n = 2;
  for (; n + 1 < arguments.size() && std::string_view(arguments[n]) != "--"; n += 2) {
    const std::string_view name = arguments[n];
    const char* value = arguments[n + 1];
    if (name == "--owner") orders.owner = static_cast<pid_t>(text::integer(value).value_or(0));
    if (name == "--folder") orders.belongings.folders.emplace_back(value);
    if (name == "--secret-file") orders.belongings.secret_file = value;
    if (name == "--secret-variable") orders.secret_variable = value;
    if (name == "--lock") orders.belongings.lock = value;
  }
  for (++n; n < arguments.size(); ++n) orders.command.push_back(arguments[n]);
  require(orders.owner > 0 && !orders.command.empty(), "a keeper's words are kept_command()'s");
  orders.command.push_back(nullptr);
  return orders;
}

bool has(const std::filesystem::path& file, const std::string& secret) {
  try {
    return !secret.empty() && read_whole_file(file, kLongestFile).find(secret) != std::string::npos;
  } catch (const Error&) {
    return false;  // it is gone, or another's
  }
}

void remove_unless_locked(const std::filesystem::path& lock) {
  const int file = ::open(lock.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return;
  // A killed owner's files are closed one by one: its lock may hold a moment longer than what told of its
  // end.
  bool locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  for (int look = 0; look < kLockLooks && !locked; ++look) {
    std::this_thread::sleep_for(kLockLook);
    locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  }
  struct stat facts {};
  // Whoever locks it now looks whether it is still there.
  if (locked && ::fstat(file, &facts) == 0 && facts.st_nlink > 0) ::unlink(lock.c_str());
  ::close(file);
}

// Whether a process is on its way out, or killed and about to be; false where it is gone.
bool is_ending(pid_t process) {
  const std::string place = "/proc/" + std::to_string(process);
  std::string stat;
  std::getline(std::ifstream(place + "/stat"), stat);
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return false;
  std::istringstream rest(stat.substr(name_end + 1));
  char state = 0;
  std::int64_t parent = 0, group = 0, session = 0, terminal = 0, foreground = 0;
  std::uint64_t flags = 0;
  rest >> state >> parent >> group >> session >> terminal >> foreground >> flags;
  if (state == 'Z' || state == 'X' || (flags & kExiting) != 0) return true;
  std::ifstream status(place + "/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("SigPnd:") && !line.starts_with("ShdPnd:")) continue;
    if ((std::strtoull(line.c_str() + 7, nullptr, 16) >> (SIGKILL - 1) & 1) != 0) return true;
  }
  return false;
}

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGCHLD, SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGQUIT})
    sigaddset(&set, number);
  return set;
}

pid_t start(const Orders& orders) {
  const pid_t keeper = getpid();
  const pid_t process = fork();
  if (process != 0) return process;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != keeper) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvp(orders.command.front(), orders.command.data());
  const nlohmann::json line{
      {"error",
       {{"code", "engine"},
        {"message", "cannot start " + std::string(orders.command.front()) + ": " + std::strerror(errno)},
        {"hint",
         "install the MPI that Footwall was built with, or name its launcher in FOOTWALL_LAUNCHER"}}}};
  std::fputs((line.dump() + "\n").c_str(), stderr);
  std::fflush(stderr);
  _exit(127);
}

// Its own children, among them those whose parents are gone.
void kill_children() {
  const std::string self = std::to_string(getpid());
  std::ifstream list("/proc/self/task/" + self + "/children");
  for (pid_t child = 0; list >> child;) ::kill(child, SIGKILL);
}

class Keeper {
 public:
  explicit Keeper(const Orders& orders) : orders_(orders), set_(watched_signals()) {}

  int run() {
    launcher_ = start(orders_);
    if (launcher_ < 0) throw io_error("start", orders_.command.front(), errno);
    while (reap()) {
      look_for_owner();
      if (status_ || (kill_at_ && Clock::now() > *kill_at_)) kill_children();
      const bool ending = status_ || kill_at_;
      heed(ending ? sigtimedwait(&set_, nullptr, &kPause) : sigwaitinfo(&set_, nullptr));
    }
    await_ending_owner();
    if (owner_is_gone_) {
      std::error_code ignored;
      for (const auto& folder : orders_.belongings.folders) std::filesystem::remove_all(folder, ignored);
    }
    if (!status_) return 1;
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_);
  }

 private:
  // False when no child is left.
  bool reap() {
    for (;;) {
      int status = 0;
      const pid_t ended = waitpid(-1, &status, WNOHANG);
      if (ended == 0) return true;
      if (ended < 0 && errno != EINTR) return false;
      if (ended == launcher_) status_ = status;
    }
  }

  void look_for_owner() {
    if (owner_is_gone_ || getppid() == orders_.owner) return;
    owner_is_gone_ = true;
    kill_at_ = Clock::now() + kTimeToEnd;
    ::kill(launcher_, SIGTERM);
    // At once: who looks there should not find an engine that ends.
    const char* secret = std::getenv(orders_.secret_variable.c_str());
    const Belongings& theirs = orders_.belongings;
    if (!theirs.secret_file.empty() && has(theirs.secret_file, secret != nullptr ? secret : ""))
      ::unlink(theirs.secret_file.c_str());
    if (!theirs.lock.empty()) remove_unless_locked(theirs.lock);
  }

  // One that was killed just now is this process's parent until its last thread is gone.
  void await_ending_owner() {
    for (int look = 0; look < kOwnerLooks && !owner_is_gone_; ++look) {
      const bool ends = is_ending(orders_.owner);
      look_for_owner();
      if (!ends) return;
      std::this_thread::sleep_for(kLockLook);
    }
  }

  void heed(int number) {
    if (number < 0 || number == SIGCHLD) return;
    if (number == SIGQUIT) kill_at_ = Clock::now();
    if (number != SIGQUIT && !status_) ::kill(launcher_, number);
  }

  const Orders& orders_;
  sigset_t set_;
  pid_t launcher_ = -1;
  std::optional<int> status_;  // the launcher's
  std::optional<Clock::time_point> kill_at_;
  bool owner_is_gone_ = false;
};

}  // namespace

std::vector<std::string> kept_command(const std::filesystem::path& program, const Belongings& belongings,
                                      const std::string& secret_variable,
                                      const std::vector<std::string>& command) {
  std::vector<std::string> words{program.string(), kWord, "--owner", std::to_string(getpid())};
  for (const auto& folder : belongings.folders) words.insert(words.end(), {"--folder", folder.string()});
  if (!belongings.secret_file.empty()) {
    words.insert(words.end(),
                 {"--secret-file", belongings.secret_file.string(), "--secret-variable", secret_variable});
  }
  if (!belongings.lock.empty()) words.insert(words.end(), {"--lock", belongings.lock.string()});
  words.emplace_back("--");
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

bool is_keeper(std::span<char* const> arguments) {
  return arguments.size() > 1 && std::string_view(arguments[1]) == kWord;
}

int keep(std::span<char* const> arguments) {
  const sigset_t set = watched_signals();
  sigprocmask(SIG_BLOCK, &set, nullptr);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_NAME, "footwall-keeper");
  const Orders orders = orders_from(arguments);
  return Keeper(orders).run();
}

}  // namespace footwall::session
