#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <ctime>
#include <optional>

#include "storage/project/detail/heartbeat.h"
#include "storage/project/detail/writer_lock.h"

namespace footwall::project::detail {
namespace {

std::string content_of(int file) {
  std::string text(4096, '\0');
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

class LocalLock : public WriterLock {
 public:
  LocalLock(const std::filesystem::path& project, const std::string& edit_socket)
      : path_(lock_path(project)) {
    // The former holder removes the file while it holds the lock, so a lock on a file that is no longer at
    // the path is worth nothing: try again with the one that is.
    do {
      if (file_ >= 0) ::close(file_);
      file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (file_ < 0) throw io_error("lock", path_.string(), errno);
      if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const int reason = errno;
        const Holder holder = Holder::from_json(content_of(file_));
        ::close(file_);
        if (reason != EWOULDBLOCK) throw io_error("lock", path_.string(), reason);
        throw held(project, holder);
      }
    } while (!still_there());
    refuse_a_lease(project);
    const std::string text = Holder::myself(edit_socket).to_json();
    if (::ftruncate(file_, 0) != 0 ||
        ::pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
      const int reason = errno;
      ::close(file_);
      throw io_error("write", path_.string(), reason);
    }
    heartbeat_.emplace(file_, fmt::format("the lock {}", path_.string()));
  }

  ~LocalLock() override {
    heartbeat_.reset();
    if (still_there()) ::unlink(path_.c_str());
    ::close(file_);
  }

  void check() override {
    if (!still_there()) {
      throw Error(ErrorCode::kHeld, fmt::format("the lock {} was removed or taken over", path_.string()),
                  "the project is read-only now; close it and open it again");
    }
  }

 private:
  // Another host may reach this folder through the network and hold the project by a lease, which no OS lock
  // here tells of.
  void refuse_a_lease(const std::filesystem::path& project) {
    const Holder holder = Holder::from_json(content_of(file_));
    if (!holder.lease) return;
    struct stat there {};
    const bool renewed = ::fstat(file_, &there) == 0 &&
                         std::abs(std::time(nullptr) - there.st_mtim.tv_sec) <= kLeaseStaleSeconds;
    if (renewed && !holder.dead()) {
      ::close(file_);
      throw held(project, holder);
    }
    taken_over_ = fmt::format("took over the lease of {}", holder.in_words());
  }

  bool still_there() const {
    struct stat mine {};
    struct stat there {};
    return ::fstat(file_, &mine) == 0 && ::stat(path_.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
           mine.st_dev == there.st_dev;
  }

  std::filesystem::path path_;
  int file_ = -1;
  std::optional<Heartbeat> heartbeat_;
};

}  // namespace

std::unique_ptr<WriterLock> lock_locally(const std::filesystem::path& project,
                                         const std::string& edit_socket) {
  return std::make_unique<LocalLock>(project, edit_socket);
}

}  // namespace footwall::project::detail
