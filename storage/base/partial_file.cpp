#include "storage/base/partial_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>

#include "storage/base/error.h"

namespace footwall {
namespace {

void flush_to_disk(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) throw io_error("open", path, errno);
  const int result = ::fsync(descriptor);
  const int failure = errno;
  ::close(descriptor);
  // Some file systems cannot flush a folder; that is not a failure to write.
  if (result != 0 && failure != EINVAL) throw io_error("flush", path, failure);
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

PartialFile::PartialFile(std::filesystem::path final_path) : final_(std::move(final_path)) {
  static std::atomic<unsigned> counter{0};
  const std::filesystem::path folder = folder_of(final_);
  std::error_code failure;
  if (!std::filesystem::is_directory(folder, failure)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no folder {}", folder.string()),
                "create it, or choose another path");
  }
  temporary_ = folder / fmt::format(".{}.partial-{}-{}", final_.filename().string(), ::getpid(), counter++);
}

PartialFile::~PartialFile() {
  if (committed_) return;
  std::error_code ignored;  // nothing more can be done for a file that is to be thrown away
  std::filesystem::remove(temporary_, ignored);
}

void PartialFile::commit() {
  flush_to_disk(temporary_, O_RDONLY);
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) throw io_error("write", final_, errno);
  committed_ = true;
  flush_to_disk(folder_of(final_), O_RDONLY | O_DIRECTORY);
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  PartialFile file(path);
  {
    std::ofstream out(file.path(), std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.flush();
    if (!out) throw io_error("write", path, errno);
  }
  file.commit();
}

std::string read_whole_file(const std::filesystem::path& path, std::size_t limit) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw io_error("read", path, errno);
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size > limit) {
    throw Error(ErrorCode::kMemory, fmt::format("{} has {} bytes, more than the {} expected", path.string(), size, limit));
  }
  std::string bytes(size, '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) throw io_error("read", path, errno);
  return bytes;
}

}  // namespace footwall
