#include "engine/service/server/requests/task_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

// A file that is closed again, whatever happens.
class Appended {
 public:
  Appended(const std::filesystem::path& path, bool is_new)
      : path_(path.string()),
        file_(::open(path_.c_str(),
                     O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW | (is_new ? O_CREAT | O_EXCL : 0), 0600)) {
    if (file_ < 0) throw io_error("write", path_, errno);
  }
  ~Appended() { ::close(file_); }
  Appended(const Appended&) = delete;
  Appended& operator=(const Appended&) = delete;

  void write(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t n = ::write(file_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw io_error("write", path_, errno);
      done += static_cast<std::size_t>(n);
    }
  }

 private:
  std::string path_;
  int file_;
};

}  // namespace

bool is_plain_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= kLongest && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), plain);
}

TaskFolder::TaskFolder(const std::filesystem::path& scratch) {
  std::string name = (scratch / "task-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw io_error("make a folder in", scratch.string(), errno);
  path_ = name;
  for (const char* sub : {"in", "out"}) {
    if (::mkdir((path_ / sub).c_str(), 0700) == 0) continue;
    const Error error = io_error("make", (path_ / sub).string(), errno);
    std::error_code trouble;
    std::filesystem::remove_all(path_, trouble);
    throw error;
  }
}

TaskFolder::~TaskFolder() {
  std::error_code trouble;  // nobody is left to tell; the engine's end removes the scratch folder
  std::filesystem::remove_all(path_, trouble);
}

void TaskFolder::add(const v1::FilePiece& piece) {
  const std::string& name = piece.name();
  if (!is_plain_name(name)) {
    throw Error(ErrorCode::kInvalid, "a file's name is not letters, digits, \"-\", \"_\" and \".\"",
                "name files without folders, at most 100 characters, not beginning with a dot");
  }
  if (!open_.empty() && open_ != name)
    throw Error(ErrorCode::kInvalid, fmt::format("{} comes before {} is whole", name, open_));
  if (whole_.contains(name)) throw Error(ErrorCode::kInvalid, fmt::format("{} comes twice", name));
  if (whole_.size() >= kMostFiles)
    throw Error(ErrorCode::kMemory, fmt::format("a task may have {} files", kMostFiles));
  bytes_ += static_cast<std::int64_t>(piece.bytes().size());
  if (bytes_ > kMostBytes) {
    throw Error(ErrorCode::kMemory, fmt::format("a task's files may have {} MiB together", kMostBytes >> 20),
                "volumes are not sent: the engine finds them by checksum");
  }
  Appended(path_ / "in" / name, open_.empty()).write(piece.bytes());
  open_ = name;
  if (!piece.last()) return;
  whole_.insert(name);
  open_.clear();
}

void TaskFolder::close() const {
  if (!open_.empty()) throw Error(ErrorCode::kInvalid, fmt::format("{} is not whole", open_));
}

}  // namespace footwall::service
