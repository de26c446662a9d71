#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <vector>

#include "engine/tasks/doctor/folder.h"
#include "storage/base/error.h"
#include "storage/project/file_system.h"

namespace footwall::tasks {
namespace {

enum class Kind : std::uint8_t { kFcntl, kFlock };

// 0 when this open file got the lock of the whole file, else errno.
int take(Kind kind, int file, bool release = false) {
  if (kind == Kind::kFlock) return ::flock(file, release ? LOCK_UN : LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  struct flock wanted {};
  wanted.l_type = static_cast<short>(release ? F_UNLCK : F_WRLCK);
  wanted.l_whence = SEEK_SET;
  return ::fcntl(file, F_SETLK, &wanted) == 0 ? 0 : errno;
}

// What another process gets that asks for the lock. Only system calls between fork and _exit.
int asked_by_another(Kind kind, const char* path) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open(path, O_RDWR | O_CLOEXEC);
    ::_exit(file < 0 ? errno : take(kind, file));
  }
  if (child < 0) throw io_error("start", "a process", errno);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EINTR;
}

// Empty where the lock keeps another process out, and lets it in afterwards.
std::string trouble_with(Kind kind, const std::filesystem::path& path) {
  const char* name = kind == Kind::kFlock ? "flock" : "fcntl";
  std::ofstream(path) << "lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) throw io_error("open", path.string(), errno);
  std::string trouble;
  if (const int refused = take(kind, file)) {
    trouble = fmt::format("{} locks do not work ({})", name, io_error("lock", "a file", refused).message());
  } else if (const int second = asked_by_another(kind, path.c_str()); second == 0) {
    trouble = fmt::format("two processes can hold one {} lock", name);
  } else if (take(kind, file, true) != 0 || asked_by_another(kind, path.c_str()) != 0) {
    trouble = fmt::format("a {} lock is not free again after its holder", name);
  }
  ::close(file);
  std::filesystem::remove(path);
  return trouble;
}

std::string trouble_with_links(const std::filesystem::path& place) {
  std::ofstream(place / "one") << "1";
  std::ofstream(place / "two") << "2";
  const bool first = ::link((place / "one").c_str(), (place / "lease").c_str()) == 0;
  const bool second = ::link((place / "two").c_str(), (place / "lease").c_str()) == 0;
  for (const char* name : {"one", "two", "lease"}) std::filesystem::remove(place / name);
  if (first && second) return "two processes can take one lease";
  return {};  // no hard links at all: the lease does without them
}

}  // namespace

Finding check_locks(const std::filesystem::path& place) {
  const bool network = project::file_system_at(place).kind == project::FileSystem::kNetwork;
  std::vector<std::string> troubles = {trouble_with(Kind::kFcntl, place / "locked"),
                                       trouble_with_links(place)};
  // On a network file system a lease does what flock does on a local one.
  if (!network) troubles.push_back(trouble_with(Kind::kFlock, place / "locked"));
  std::erase(troubles, std::string());
  if (troubles.empty()) {
    return ok(network ? "fcntl locks and leases keep a second process out"
                      : "fcntl and flock keep a second process out");
  }
  return failed(
      fmt::format("{}", fmt::join(troubles, "; ")),
      network ? "mount it with locks (NFS: without nolock; Lustre: with flock), or keep projects elsewhere"
              : "keep projects elsewhere");
}

}  // namespace footwall::tasks
