#include "storage/volume/disk_room.h"

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include "storage/base/error.h"
#include "storage/volume/min_max.h"

namespace footwall::volume {

std::int64_t expected_bytes(const ChunkGrid& grid) {
  const survey::Index n_chunks = grid.counts();
  const double voxels = static_cast<double>(n_chunks[0]) * static_cast<double>(n_chunks[1]) *
                        static_cast<double>(n_chunks[2]) * static_cast<double>(grid.voxels());
  if (voxels > 1e17) {  // what follows stays far below 2^63
    throw Error(ErrorCode::kInvalid,
                fmt::format("a volume of {} x {} x {} voxels is more than a file can hold", grid.dims[0],
                            grid.dims[1], grid.dims[2]));
  }
  std::int64_t bytes =
      grid.count() * (grid.voxels() * 4 + 8) + grid.dims[0] * grid.dims[1] + (std::int64_t{4} << 20);
  for (int level = 0; level < min_max_levels(grid.dims); ++level) {
    const survey::Index n = min_max_dims(grid.dims, level);
    bytes += n[0] * n[1] * n[2] * 12;
  }
  return bytes;
}

void reserve(const std::filesystem::path& path, std::int64_t bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw io_error("open", path, errno);
  int failure = ::fallocate(descriptor, 0, 0, bytes) == 0 ? 0 : errno;
  if (failure == EOPNOTSUPP || failure == ENOSYS) failure = ::ftruncate(descriptor, bytes) == 0 ? 0 : errno;
  ::close(descriptor);
  if (failure != 0) {
    throw Error(ErrorCode::kIo,
                fmt::format("cannot write {}: it needs {} MiB: {}", path.string(), bytes >> 20,
                            std::strerror(failure)),
                "free some space, raise the limit on file sizes, or choose another folder");
  }
}

}  // namespace footwall::volume
