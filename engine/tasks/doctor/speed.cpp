#include "engine/tasks/doctor/speed.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <vector>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kBlock = std::int64_t{4} << 20;
constexpr std::int64_t kMost = std::int64_t{256} << 20;
constexpr std::int64_t kLeast = std::int64_t{16} << 20;
constexpr double kSecondsToWrite = 10;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::max(1e-6, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

class Trial {
 public:
  explicit Trial(const std::filesystem::path& folder) : path_(folder / "speed") {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file_ < 0) throw io_error("write", path_.string(), errno);
  }
  ~Trial() {
    ::close(file_);
    ::unlink(path_.c_str());
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  // Bytes that no file system can shrink, different in every block.
  void fill(std::int64_t number) {
    std::uint64_t state = 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(number + 1);
    for (std::uint64_t& word : expected_) {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      word = state;
    }
  }
  void write(std::int64_t number) {
    const auto* bytes = reinterpret_cast<const char*>(expected_.data());
    for (std::int64_t done = 0; done < kBlock;) {
      const ssize_t wrote =
          ::pwrite(file_, bytes + done, static_cast<std::size_t>(kBlock - done), number * kBlock + done);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0) throw io_error("write", path_.string(), errno);
      done += wrote;
    }
  }
  void flush() const {
    if (::fsync(file_) != 0) throw io_error("flush", path_.string(), errno);
    ::posix_fadvise(file_, 0, 0, POSIX_FADV_DONTNEED);
  }
  void read(std::int64_t number) {
    auto* bytes = reinterpret_cast<char*>(found_.data());
    for (std::int64_t done = 0; done < kBlock;) {
      const ssize_t got =
          ::pread(file_, bytes + done, static_cast<std::size_t>(kBlock - done), number * kBlock + done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw io_error("read", path_.string(), errno);
      if (got == 0) throw Error(ErrorCode::kCorrupt, path_.string() + " is shorter than what was written");
      done += got;
    }
  }
  void compare() const {
    if (expected_ == found_) return;
    throw Error(ErrorCode::kCorrupt, path_.string() + " does not hold what was written to it",
                "do not keep anything here");
  }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::vector<std::uint64_t> expected_ = std::vector<std::uint64_t>(kBlock / 8);
  std::vector<std::uint64_t> found_ = std::vector<std::uint64_t>(kBlock / 8);
};

}  // namespace

std::int64_t bytes_to_measure(std::int64_t free_bytes) {
  const std::int64_t bytes = std::min(kMost, free_bytes / 10) / kBlock * kBlock;
  return bytes < kLeast ? 0 : bytes;
}

Speed measure_speed(const std::filesystem::path& folder, std::int64_t bytes, const JobContext& job) {
  require(bytes >= kBlock, "at least a block to write");
  Trial trial(folder);
  // Only the system's calls are timed, not the making and comparing of bytes.
  double writing = 0;
  double reading = 0;
  std::int64_t blocks = 0;
  for (; blocks < bytes / kBlock && writing < kSecondsToWrite; ++blocks) {
    job.check();
    trial.fill(blocks);
    const auto start = std::chrono::steady_clock::now();
    trial.write(blocks);
    writing += seconds_since(start);
  }
  const auto flushing = std::chrono::steady_clock::now();
  trial.flush();
  writing += seconds_since(flushing);
  for (std::int64_t block = 0; block < blocks; ++block) {
    job.check();
    const auto start = std::chrono::steady_clock::now();
    trial.read(block);
    reading += seconds_since(start);
    trial.fill(block);
    trial.compare();
  }
  const auto megabytes = static_cast<double>(blocks * kBlock) / 1e6;
  return {blocks * kBlock, megabytes / writing, megabytes / reading};
}

}  // namespace footwall::tasks
