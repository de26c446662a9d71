#include "storage/volume/chunk_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "storage/base/error.h"
#include "storage/base/pages.h"

namespace footwall::volume {
namespace {

// 0, or the errno of what went wrong.
int write_all(int descriptor, std::int64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    offset += written;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

bool on_pages(std::int64_t offset, std::span<const std::byte> bytes) {
  return (static_cast<std::uintptr_t>(offset) | reinterpret_cast<std::uintptr_t>(bytes.data()) |
          bytes.size()) %
             kPageBytes ==
         0;
}

}  // namespace

ChunkOutput::ChunkOutput(std::filesystem::path path)
    : path_(std::move(path)),
      cached_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)),
      direct_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_DIRECT)) {
  if (cached_ < 0) {
    const int failure = errno;
    if (direct_ >= 0) ::close(direct_);
    throw io_error("open", path_, failure);
  }
}

ChunkOutput::~ChunkOutput() {
  ::close(cached_);
  if (direct_ >= 0) ::close(direct_);
}

void ChunkOutput::write(std::int64_t offset, std::span<const std::byte> bytes) const {
  int failure = EINVAL;
  if (direct_ >= 0 && on_pages(offset, bytes)) failure = write_all(direct_, offset, bytes);
  // EINVAL: a file system that opens directly but wants larger units than pages.
  if (failure == EINVAL) {
    failure = write_all(cached_, offset, bytes);
    if (failure == 0) {
      ::sync_file_range(cached_, offset, static_cast<off_t>(bytes.size()), SYNC_FILE_RANGE_WRITE);
    }
  }
  if (failure != 0) throw io_error("write", path_, failure);
}

void ChunkOutput::flush() const {
  if (::fdatasync(cached_) != 0) throw io_error("flush", path_, errno);
}

}  // namespace footwall::volume
