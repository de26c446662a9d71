#include "engine/session/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "storage/base/error.h"

namespace footwall::session {
namespace {

constexpr std::size_t kLongestLine = 1 << 16;

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& each : texts) result.push_back(each.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::vector<std::string>& settings) {
  std::vector<std::string> all = settings;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool replaced = std::any_of(settings.begin(), settings.end(),
                                      [&](const std::string& s) { return s.starts_with(name); });
    if (!replaced) all.push_back(text);
  }
  return all;
}

// Between fork and exec: only calls that are safe in the child of a program with threads.
[[noreturn]] void become(char* const* words, char* const* environment, pid_t parent, int output, int report) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGHUP, SIGUSR1, SIGUSR2}) ::signal(number, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execvpe(words[0], words, environment);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(report, &error, sizeof error);
  _exit(127);
}

}  // namespace

Child::Child(const std::vector<std::string>& command, const std::vector<std::string>& settings) {
  require(!command.empty(), "a command");
  std::vector<std::string> words = command;
  std::vector<std::string> environment = environment_with(settings);
  const std::vector<char*> word_pointers = pointers(words);
  const std::vector<char*> environment_pointers = pointers(environment);
  int output[2];
  int report[2];
  if (pipe2(output, O_CLOEXEC) != 0) throw io_error("make", "a pipe", errno);
  if (pipe2(report, O_CLOEXEC) != 0) {
    const int error = errno;
    close(output[0]);
    close(output[1]);
    throw io_error("make", "a pipe", error);
  }
  const pid_t parent = getpid();
  process_ = fork();
  const int fork_error = errno;
  if (process_ == 0) become(word_pointers.data(), environment_pointers.data(), parent, output[1], report[1]);
  close(output[1]);
  close(report[1]);
  output_ = output[0];
  int error = process_ < 0 ? fork_error : 0;
  if (process_ > 0 && read(report[0], &error, sizeof error) != sizeof error) error = 0;
  close(report[0]);
  if (error == 0) return;
  if (process_ > 0) waitpid(process_, nullptr, 0);
  process_ = -1;
  close(output_);
  throw Error(ErrorCode::kEngine, "cannot start " + command[0] + ": " + std::strerror(error),
              "install the MPI that Footwall was built with, or name its launcher in FOOTWALL_LAUNCHER");
}

Child::~Child() {
  if (process_ > 0) {
    kill_group();
    waitpid(process_, nullptr, 0);
  }
  if (output_ >= 0) close(output_);
}

bool Child::read_lines(int timeout_ms, const std::function<void(const std::string&)>& line) {
  pollfd wanted{output_, POLLIN, 0};
  if (poll(&wanted, 1, timeout_ms) <= 0) return true;
  std::array<char, 4096> bytes;
  const ssize_t got = read(output_, bytes.data(), bytes.size());
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  const auto hand_over = [&](std::size_t length) {
    const std::string whole = pending_.substr(0, length);
    pending_.erase(0, std::min(pending_.size(), length + 1));
    if (!whole.empty()) line(whole);
  };
  if (got == 0) {
    hand_over(pending_.size());
    return false;
  }
  pending_.append(bytes.data(), static_cast<std::size_t>(got));
  for (std::size_t end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n'))
    hand_over(end);
  if (pending_.size() > kLongestLine) hand_over(pending_.size());
  return true;
}

void Child::signal(int number) const {
  if (process_ > 0) ::kill(process_, number);
}

void Child::kill_group() const {
  if (process_ > 0) ::kill(-process_, SIGKILL);
}

int Child::wait() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

}  // namespace footwall::session
