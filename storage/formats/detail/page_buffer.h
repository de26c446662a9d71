// A piece of a file in memory, read in whole pages.
#pragma once
#include "storage/base/pages.h"
#include "storage/formats/detail/read_only_file.h"

namespace footwall::formats::detail {

class PageBuffer {
 public:
  PageBuffer() = default;
  // Makes this the buffer of [offset, offset + size), past the page cache where the bytes are not in it, or
  // through it. Memory grows to the largest piece and is kept. Throws kIo, kMemory, kCorrupt where the file
  // ends before.
  enum class Way : std::uint8_t { kPastCache, kThroughCache };
  void read(const ReadOnlyFile& file, std::int64_t offset, std::int64_t size, Way way);
  // The same only if all of it is in the page cache; else false, and it holds nothing.
  bool read_if_cached(const ReadOnlyFile& file, std::int64_t offset, std::int64_t size);

  bool holds(std::int64_t offset, std::int64_t size) const {
    return offset >= offset_ && offset + size <= offset_ + size_;
  }
  // The byte at this offset of the file, which it holds, and those after it.
  const std::byte* at(std::int64_t offset) const { return bytes_.get() + (offset - start_); }

 private:
  void make_room(std::int64_t offset, std::int64_t size);

  Pages bytes_;
  std::size_t capacity_ = 0;
  std::int64_t start_ = 0;  // offset of the first byte in memory
  std::int64_t offset_ = 0;
  std::int64_t size_ = 0;
};

}  // namespace footwall::formats::detail
