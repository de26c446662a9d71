#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <optional>

#include "storage/base/log.h"
#include "storage/project/detail/heartbeat.h"
#include "storage/project/detail/writer_lock.h"

namespace footwall::project::detail {
namespace {

class Lease : public WriterLock {
 public:
  Lease(const std::filesystem::path& project, const std::string& edit_socket)
      : project_(project), path_(lock_path(project)), me_(Holder::myself(edit_socket)) {
    me_.lease = true;
    candidate_ = path_;
    candidate_ += "." + me_.token;
    file_ = written(candidate_);
    if (file_ < 0) throw io_error("write", candidate_.string(), errno);
    try {
      take();
    } catch (...) {
      ::close(file_);
      ::unlink(candidate_.c_str());
      throw;
    }
    ::unlink(candidate_.c_str());
    heartbeat_.emplace(file_, fmt::format("the lease on {}", project_.string()));
  }

  ~Lease() override {
    heartbeat_.reset();
    if (mine()) remove_if_of(me_.token);
    ::close(file_);
  }

  void check() override {
    if (mine()) return;
    const Holder now = holder_of(path_);
    throw Error(ErrorCode::kHeld,
                fmt::format("the lease on {} was lost: {}", project_.string(),
                            now.token.empty() ? std::string("its lock file is gone or was changed")
                                              : "taken over by " + now.in_words()),
                "the project is read-only now; close it and open it again");
  }

 private:
  // A new file with our name in it, flushed; -1 with errno where there is one already, or for any other
  // reason.
  int written(const std::filesystem::path& path) const {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) return -1;
    const std::string text = me_.to_json();
    const ssize_t size = ::pwrite(file, text.data(), text.size(), 0);
    if (size == static_cast<ssize_t>(text.size()) && ::fsync(file) == 0) return file;
    const int reason = size >= 0 && size < static_cast<ssize_t>(text.size()) ? ENOSPC : errno;
    ::close(file);
    ::unlink(path.c_str());
    errno = reason;
    return -1;
  }

  // Puts our file at the lock's name; false where another's is there.
  bool put_up() {
    if (::link(candidate_.c_str(), path_.c_str()) == 0) return true;
    if (errno == EPERM || errno == EOPNOTSUPP || errno == ENOSYS || errno == EMLINK) {
      // No hard links here (SMB, FAT): a file that only one can create does as well; for a moment it is
      // empty.
      const int file = written(path_);
      if (file >= 0) {
        ::close(file_);
        file_ = file;
        return true;
      }
    }
    if (errno != EEXIST) throw io_error("lease", path_.string(), errno);
    return false;
  }

  // Steps: 1. put our file at the name, which succeeds for one only; 2. otherwise look at the holder: alive
  // means refusal; 3. a stale lease is moved aside, and put back if another had replaced it in the meantime.
  void take() {
    for (int attempt = 0; attempt < 10; ++attempt) {
      if (put_up()) return;
      const Holder holder = holder_of(path_);
      if (holder.token.empty() && !std::filesystem::exists(path_)) continue;
      if (!holder.dead() && !stale()) throw held(project_, holder);
      if (remove_if_of(holder.token))
        taken_over_ = fmt::format("took over the lease of {}", holder.in_words());
    }
    throw held(project_, holder_of(path_));
  }

  // Moved aside first, because between a look and a removal another may have put his own file there.
  bool remove_if_of(const std::string& token) const {
    std::filesystem::path aside = candidate_;
    aside += ".stale";
    if (::rename(path_.c_str(), aside.c_str()) != 0) return false;
    const bool as_expected = holder_of(aside).token == token;
    if (!as_expected && ::link(aside.c_str(), path_.c_str()) != 0) {
      log::warn(fmt::format("a fresh lease on {} was disturbed: its holder will find itself read-only",
                            project_.string()));
    }
    ::unlink(aside.c_str());
    return as_expected;
  }

  // The server's clock stands in our own file, written just now; this host's clock may differ. A time far
  // ahead of it was set before the server's clock was put back: nobody renews that one either.
  bool stale() const {
    struct stat there {};
    struct stat now {};
    if (::stat(path_.c_str(), &there) != 0) return false;
    if (::futimens(file_, nullptr) != 0 || ::fstat(file_, &now) != 0) return false;
    return std::abs(now.st_mtim.tv_sec - there.st_mtim.tv_sec) > kLeaseStaleSeconds;
  }

  bool mine() const { return holder_of(path_).token == me_.token; }

  std::filesystem::path project_;
  std::filesystem::path path_;
  std::filesystem::path candidate_;
  Holder me_;
  int file_ = -1;
  // Touches our own file: if another has taken the name, his lease is not renewed by us.
  std::optional<Heartbeat> heartbeat_;
};

}  // namespace

std::unique_ptr<WriterLock> lease(const std::filesystem::path& project, const std::string& edit_socket) {
  return std::make_unique<Lease>(project, edit_socket);
}

}  // namespace footwall::project::detail
