#include "storage/base/partial_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

#include <array>
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

// How the temporary names for this file begin.
std::string temporary_start(const std::filesystem::path& final_path) {
  return fmt::format(".{}.partial-", final_path.filename().string());
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
  temporary_ = folder / fmt::format("{}{}-{}", temporary_start(final_), ::getpid(), counter++);
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

void remove_partial_files_of(const std::filesystem::path& final_path) {
  const std::string start = temporary_start(final_path);
  std::error_code ignored;  // as for a file that is thrown away
  for (const auto& entry : std::filesystem::directory_iterator(folder_of(final_path), ignored)) {
    if (entry.path().filename().string().starts_with(start)) std::filesystem::remove(entry.path(), ignored);
  }
}

void refuse_to_replace_storage(const std::filesystem::path& path) {
  // Told by the first bytes, so that it holds for every project, by whatever name or link it is reached.
  constexpr std::string_view kSqlite{"SQLite format 3\0", 16};
  constexpr std::string_view kVolume = "footwall volume\n";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  std::array<char, 16> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  const std::string_view bytes(start.data(), start.size());
  const bool project = bytes == kSqlite;
  if (!project && bytes != kVolume) return;
  throw Error(
      ErrorCode::kInvalid,
      fmt::format("{} is a {} and is not written over", path.string(), project ? "project" : "volume"),
      "choose another name for the output");
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
  // A folder opens like a file and says that it is endless.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw io_error("read", path, EISDIR);
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw io_error("read", path, errno);
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size > limit) {
    throw Error(ErrorCode::kMemory,
                fmt::format("{} has {} bytes, more than the {} expected", path.string(), size, limit));
  }
  std::string bytes(size, '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) throw io_error("read", path, errno);
  return bytes;
}

}  // namespace footwall
