#include "storage/formats/detail/page_buffer.h"

#include "storage/base/error.h"

namespace footwall::formats::detail {

void PageBuffer::read(const ReadOnlyFile& file, std::int64_t offset, std::int64_t size, Way way) {
  constexpr auto kPage = static_cast<std::int64_t>(kPageBytes);
  size_ = 0;  // holds nothing, should what follows throw
  const std::int64_t start = offset / kPage * kPage;
  const std::int64_t end = (offset + size + kPage - 1) / kPage * kPage;
  const auto bytes = static_cast<std::size_t>(end - start);
  if (bytes > capacity_) {
    bytes_ = nullptr;  // before the larger one is taken
    capacity_ = 0;
    bytes_ = allocate_pages(bytes);
    capacity_ = bytes;
  }
  start_ = start;
  if (way == Way::kThroughCache) {
    file.read_at(offset, {bytes_.get() + (offset - start), static_cast<std::size_t>(size)});
  } else if (const auto got = static_cast<std::int64_t>(file.read_pages(start, {bytes_.get(), bytes}));
             start + got < offset + size) {
    throw_ended(file, start + got, offset + size - start - got);
  }
  offset_ = offset;
  size_ = size;
}

}  // namespace footwall::formats::detail
