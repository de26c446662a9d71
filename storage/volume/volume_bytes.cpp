#include "storage/volume/volume_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <vector>

#include "storage/base/hash.h"
#include "storage/volume/min_max.h"
#include "storage/volume/preamble.h"
#include "storage/volume/volume_file.h"
#include "storage/volume/volume_reader.h"

namespace footwall::volume {
namespace {

constexpr std::int64_t kPiece = std::int64_t{1} << 20;

class PlainFile {
 public:
  explicit PlainFile(const std::filesystem::path& path) : path_(path) {
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) throw io_error("read", path.string(), errno);
    ::posix_fadvise(file_, 0, 0, POSIX_FADV_SEQUENTIAL);
  }
  ~PlainFile() { ::close(file_); }
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  void read(std::span<std::byte> into) const {
    while (!into.empty()) {
      const ssize_t got = ::read(file_, into.data(), into.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw io_error("read", path_.string(), errno);
      if (got == 0) throw Error(ErrorCode::kIo, path_.string() + " became shorter while it was read");
      into = into.subspan(static_cast<std::size_t>(got));
    }
  }

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace

void each_verified_piece(const std::filesystem::path& path, const JobContext& job,
                         const std::function<void(std::span<const std::byte>)>& take) {
  // 1. All that is not a chunk, through the reader, which checks it.
  const VolumeReader reader(path);
  reader.live_mask();
  for (int level = 0; level < min_max_levels(reader.info().dims); ++level) reader.min_max(level);

  // 2. The bytes: what stands in front of the chunks, the chunks, what follows them.
  const Preamble preamble = read_preamble(path);
  const ChunkGrid& grid = preamble.grid;
  const std::int64_t chunk_bytes = grid.voxels() * static_cast<std::int64_t>(sizeof(float));
  const PlainFile file(path);
  std::vector<std::byte> piece(static_cast<std::size_t>(std::max(chunk_bytes, kPiece)));
  const auto next = [&](std::int64_t bytes) {
    job.check();
    const auto part = std::span(piece).first(static_cast<std::size_t>(bytes));
    file.read(part);
    return part;
  };
  const auto copy = [&](std::int64_t bytes) {
    for (std::int64_t done = 0; done < bytes; done += kPiece) take(next(std::min(kPiece, bytes - done)));
  };
  copy(preamble.voxels_at);
  for (std::int64_t number = 0; number < grid.count(); ++number) {
    const auto chunk = next(chunk_bytes);
    if (hash64(chunk) != reader.chunk_hashes()[static_cast<std::size_t>(number)])
      throw_altered(grid, number, path, "was altered");
    take(chunk);
  }
  copy(preamble.bytes - preamble.voxels_at - grid.count() * chunk_bytes);
}

}  // namespace footwall::volume
