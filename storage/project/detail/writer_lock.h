// One writer at a time. The file NAME.footwall.lock says who: host, process id, that process's start time
// (ids are reused), and the socket on which the holder takes edits.
//
// On a local file system an OS lock (flock) on that file decides at once and ends with the process. On a
// network file system, where such locks may lie, the file's existence is a lease: its holder renews it every
// 15 s, and a lease not renewed for 60 s (by the server's clock), or of a dead process of this machine, is
// taken over. A holder that was taken over notices before its next edit.
//
// A folder that is local for its server and a network one for everybody else is seen both ways at once: so
// the holder of the OS lock renews the file too, and honours a lease that he finds there.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "storage/base/error.h"
#include "storage/project/project.h"

namespace footwall::project::detail {

inline constexpr int kLeaseStaleSeconds = 60;
inline constexpr int kLeaseRenewSeconds = 15;

struct Holder {
  std::string host;
  std::int64_t pid = 0;
  std::int64_t process_start = 0;  // in clock ticks since boot, /proc/PID/stat field 22
  std::string since;               // UTC
  std::string edit_socket;
  std::string token;    // tells one lease from another
  std::string machine;  // the running kernel and its process numbers: hosts may share a name
  bool lease = false;   // held by the file's existence, not by an OS lock

  static Holder myself(const std::string& edit_socket);
  std::string to_json() const;
  // Nothing is promised about the text: unreadable parts stay empty.
  static Holder from_json(const std::string& text);
  // "process 123 on host 'a' since 2024-..."
  std::string in_words() const;
  // True when this is a process of this machine that is gone.
  bool dead() const;
};

class WriterLock {
 public:
  virtual ~WriterLock() = default;
  // Throws kHeld naming the new holder when the lock was lost.
  virtual void check() = 0;
  // What the user should be told and the project should record; empty when nothing happened.
  const std::string& taken_over() const { return taken_over_; }

 protected:
  std::string taken_over_;
};

std::filesystem::path lock_path(const std::filesystem::path& project);
// What a lock file says; empty where there is none or it cannot be read.
Holder holder_of(const std::filesystem::path& lock_file);

// Throws kHeld naming the holder, kIo.
std::unique_ptr<WriterLock> lock_locally(const std::filesystem::path& project,
                                         const std::string& edit_socket);
std::unique_ptr<WriterLock> lease(const std::filesystem::path& project, const std::string& edit_socket);

Error held(const std::filesystem::path& project, const Holder& holder);

}  // namespace footwall::project::detail
