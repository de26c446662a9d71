#include "storage/formats/detail/read_only_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "storage/base/error.h"

namespace footwall::formats::detail {

ReadOnlyFile::ReadOnlyFile(std::filesystem::path path) : path_(std::move(path)) {
  // O_NONBLOCK: a named pipe must not hang us before it is refused below.
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) {
    if (errno == ENOENT)
      throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path_.string()));
    throw io_error("read", path_, errno);
  }
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    const int failure = errno;
    ::close(descriptor_);
    if (!known) throw io_error("read", path_, failure);
    throw Error(ErrorCode::kFormat, fmt::format("{} is not a file", path_.string()));
  }
  size_ = status.st_size;
}

ReadOnlyFile::~ReadOnlyFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ReadOnlyFile::ReadOnlyFile(ReadOnlyFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

void ReadOnlyFile::read_at(std::int64_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                             static_cast<off_t>(offset + static_cast<std::int64_t>(done)));
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (got == 0) {
      throw Error(ErrorCode::kCorrupt,
                  fmt::format("{} ends at byte {}, {} bytes more were expected", path_.string(),
                              offset + static_cast<std::int64_t>(done), bytes.size() - done),
                  "the file was cut short, or is still being copied");
    } else if (errno != EINTR) {
      throw io_error("read", path_, errno);
    }
  }
}

// Advice may be ignored by the file system; reading works all the same.
void ReadOnlyFile::expect_sequential() const {
  ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

void ReadOnlyFile::expect_scattered() const {
  ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_RANDOM);
}

}  // namespace footwall::formats::detail
