// Puts chunks where HDF5 has made room for them, past HDF5 and, where the file system allows it, past the
// page cache: the bytes go from the writer's memory to the disk, no copy is made, and the disk is busy while
// the next block is computed instead of at the end.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace footwall::volume {

class ChunkOutput {
 public:
  // The file must exist; nothing else may write the byte ranges that write() is given. Throws kIo.
  explicit ChunkOutput(std::filesystem::path path);
  ~ChunkOutput();
  ChunkOutput(const ChunkOutput&) = delete;
  ChunkOutput& operator=(const ChunkOutput&) = delete;

  // Writes all bytes at this offset. May be called from several threads at once. Ranges that do not start
  // and end on pages of the file and of memory go through the page cache, and their way to the disk is
  // started at once. The caller flushes the file at the end (PartialFile::commit). Throws kIo.
  void write(std::int64_t offset, std::span<const std::byte> bytes) const;
  // Waits until what this machine wrote is on the disk; errors of late writes come to light here. Throws kIo.
  void flush() const;

 private:
  std::filesystem::path path_;
  int cached_ = -1;
  int direct_ = -1;  // -1 where the file system knows no direct writes
};

}  // namespace footwall::volume
