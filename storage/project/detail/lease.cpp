#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/project/detail/writer_lock.h"

namespace footwall::project::detail {
namespace {

class Lease : public WriterLock {
 public:
  Lease(const std::filesystem::path& project, const std::string& edit_socket)
      : project_(project), path_(lock_path(project)), me_(Holder::myself(edit_socket)) {
    candidate_ = path_;
    candidate_ += "." + me_.token;
    write_candidate();
    try {
      take();
    } catch (...) {
      ::close(file_);
      ::unlink(candidate_.c_str());
      throw;
    }
    ::unlink(candidate_.c_str());
    heartbeat_ = std::thread([this] { renew(); });
  }

  ~Lease() override {
    {
      const std::lock_guard guard(mutex_);
      ended_ = true;
    }
    wake_.notify_all();
    heartbeat_.join();
    if (mine()) ::unlink(path_.c_str());
    ::close(file_);
  }

  void check() override {
    if (mine()) return;
    throw Error(ErrorCode::kHeld,
                fmt::format("the lease on {} was lost: {}", project_.string(),
                            holder_now().token.empty() ? std::string("its lock file is gone")
                                                       : "taken over by " + holder_now().in_words()),
                "the project is read-only now; close it and open it again");
  }

 private:
  void write_candidate() {
    file_ = ::open(candidate_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) throw io_error("write", candidate_.string(), errno);
    const std::string text = me_.to_json();
    if (::pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()) ||
        ::fsync(file_) != 0) {
      const int reason = errno;
      ::close(file_);
      ::unlink(candidate_.c_str());
      throw io_error("write", candidate_.string(), reason);
    }
  }

  // Steps: 1. link our file to the name, which succeeds for one only; 2. otherwise look at the holder: alive
  // means refusal; 3. a stale lease is moved aside, and put back if another had replaced it in the meantime.
  void take() {
    for (int attempt = 0; attempt < 10; ++attempt) {
      if (::link(candidate_.c_str(), path_.c_str()) == 0) return;
      if (errno != EEXIST) throw io_error("lease", path_.string(), errno);
      const Holder holder = holder_now();
      if (holder.token.empty() && !std::filesystem::exists(path_)) continue;
      if (!holder.dead() && !stale()) throw held(project_, holder);
      std::filesystem::path aside = candidate_;
      aside += ".stale";
      if (::rename(path_.c_str(), aside.c_str()) != 0) continue;
      if (read_holder(aside).token != holder.token) {
        const int back = ::link(aside.c_str(), path_.c_str());
        ::unlink(aside.c_str());
        if (back != 0) log::warn(fmt::format("a fresh lease on {} was disturbed", project_.string()));
        continue;
      }
      ::unlink(aside.c_str());
      taken_over_ = fmt::format("took over the lease of {}", holder.in_words());
    }
    throw held(project_, holder_now());
  }

  // The server's clock stands in our own file, written just now; this host's clock may differ.
  bool stale() const {
    struct stat there {};
    struct stat now {};
    if (::stat(path_.c_str(), &there) != 0) return false;
    if (::futimens(file_, nullptr) != 0 || ::fstat(file_, &now) != 0) return false;
    return now.st_mtim.tv_sec - there.st_mtim.tv_sec > kLeaseStaleSeconds;
  }

  static Holder read_holder(const std::filesystem::path& path) {
    try {
      return Holder::from_json(read_whole_file(path, 4096));
    } catch (const Error&) {
      return {};  // gone in the meantime, or not a lease: nobody we could name
    }
  }
  Holder holder_now() const { return read_holder(path_); }
  bool mine() const { return holder_now().token == me_.token; }

  // Touches our own file: if another has taken the name, his lease is not renewed by us.
  void renew() {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::seconds(kLeaseRenewSeconds), [this] { return ended_; })) {
      if (::futimens(file_, nullptr) != 0)
        log::warn(fmt::format("cannot renew the lease on {}", project_.string()));
    }
  }

  std::filesystem::path project_;
  std::filesystem::path path_;
  std::filesystem::path candidate_;
  Holder me_;
  int file_ = -1;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread heartbeat_;
};

}  // namespace

std::unique_ptr<WriterLock> lease(const std::filesystem::path& project, const std::string& edit_socket) {
  return std::make_unique<Lease>(project, edit_socket);
}

}  // namespace footwall::project::detail
