#include "storage/formats/detail/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "storage/base/error.h"

namespace footwall::formats::detail {
namespace {

int open_unnamed(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return descriptor;
  // A file system that has no unnamed files: the name goes at once.
  std::string name = (folder / ".footwall-scratch-XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

ScratchFile::ScratchFile(const std::filesystem::path& folder, std::int64_t bytes)
    : folder_(folder.empty() ? std::filesystem::path(".") : folder), descriptor_(open_unnamed(folder_)) {
  if (descriptor_ < 0) throw io_error("make a scratch file in", folder_, errno);
  int failure = ::fallocate(descriptor_, 0, 0, bytes) == 0 ? 0 : errno;
  if (failure == EOPNOTSUPP || failure == ENOSYS) failure = ::ftruncate(descriptor_, bytes) == 0 ? 0 : errno;
  if (failure != 0) {
    ::close(descriptor_);
    throw Error(ErrorCode::kIo,
                fmt::format("unpacking needs {} MiB in {}: {}", bytes >> 20, folder_.string(),
                            std::strerror(failure)),
                "free some space there");
  }
}

ScratchFile::~ScratchFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ScratchFile::ScratchFile(ScratchFile&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

void ScratchFile::write_at(std::int64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto put = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (put > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(put));
      offset += put;
    } else if (put == 0 || errno != EINTR) {
      throw io_error("write a scratch file in", folder_, put == 0 ? ENOSPC : errno);
    }
  }
}

void ScratchFile::read_at(std::int64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const auto got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      offset += got;
    } else if (got == 0 || errno != EINTR) {
      throw io_error("read a scratch file in", folder_, got == 0 ? EIO : errno);
    }
  }
}

}  // namespace footwall::formats::detail
