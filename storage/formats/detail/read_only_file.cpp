#include "storage/formats/detail/read_only_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "storage/base/error.h"
#include "storage/base/pages.h"

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
    throw Error(ErrorCode::kFormat, fmt::format("{} is not a file", path_.string()),
                "name the file itself: folders, pipes and devices are not read");
  }
  size_ = status.st_size;
  // By way of the open descriptor, so that it is the same file even if another has taken its name.
  direct_ = ::open(fmt::format("/proc/self/fd/{}", descriptor_).c_str(), O_RDONLY | O_CLOEXEC | O_DIRECT);
}

ReadOnlyFile::~ReadOnlyFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (direct_ >= 0) ::close(direct_);
}

ReadOnlyFile::ReadOnlyFile(ReadOnlyFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      direct_(std::exchange(other.direct_, -1)),
      size_(other.size_) {}

void ReadOnlyFile::read_at(std::int64_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                             static_cast<off_t>(offset + static_cast<std::int64_t>(done)));
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (got == 0) {
      throw_ended(*this, offset + static_cast<std::int64_t>(done),
                  static_cast<std::int64_t>(bytes.size() - done));
    } else if (errno != EINTR) {
      throw io_error("read", path_, errno);
    }
  }
}

std::size_t ReadOnlyFile::read_pages(std::int64_t offset, std::span<std::byte> pages) const {
  require(offset % static_cast<std::int64_t>(kPageBytes) == 0 && pages.size() % kPageBytes == 0 &&
              reinterpret_cast<std::uintptr_t>(pages.data()) % kPageBytes == 0,
          "whole pages");
  const auto at = [&](std::size_t done) {
    return static_cast<off_t>(offset + static_cast<std::int64_t>(done));
  };
  const auto ended = [&](std::size_t done) { return at(done) >= size_; };
  iovec all{pages.data(), pages.size()};
  const ssize_t cached = ::preadv2(descriptor_, &all, 1, offset, RWF_NOWAIT);
  std::size_t done = cached > 0 ? static_cast<std::size_t>(cached) : 0;
  if (done == pages.size() || ended(done)) return done;
  done -= done % kPageBytes;
  bool direct = direct_ >= 0;
  while (done < pages.size() && !ended(done)) {
    const ssize_t got =
        ::pread(direct ? direct_ : descriptor_, pages.data() + done, pages.size() - done, at(done));
    if (got > 0) {
      done += static_cast<std::size_t>(got);
      // The file's last bytes, or a file system that stopped in the middle of a page.
      if (done % kPageBytes != 0) direct = false;
    } else if (got == 0) {
      break;
    } else if (direct && errno == EINVAL) {
      direct = false;  // it wants larger units than pages
    } else if (errno != EINTR) {
      throw io_error("read", path_, errno);
    }
  }
  return done;
}

bool ReadOnlyFile::read_if_cached(std::int64_t offset, std::span<std::byte> bytes) const {
  iovec all{bytes.data(), bytes.size()};
  return ::preadv2(descriptor_, &all, 1, offset, RWF_NOWAIT) == static_cast<ssize_t>(bytes.size());
}

void ReadOnlyFile::will_need(std::int64_t offset, std::int64_t bytes) const {
  ::posix_fadvise(descriptor_, offset, bytes, POSIX_FADV_WILLNEED);
}

// Advice may be ignored by the file system; reading works all the same.
void ReadOnlyFile::expect_sequential() const {
  ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

void ReadOnlyFile::expect_scattered() const {
  ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_RANDOM);
}

void throw_ended(const ReadOnlyFile& file, std::int64_t at, std::int64_t missing) {
  throw Error(
      ErrorCode::kCorrupt,
      fmt::format("{} ends at byte {}, {} bytes more were expected", file.path().string(), at, missing),
      "the file was cut short, or is still being copied");
}

}  // namespace footwall::formats::detail
