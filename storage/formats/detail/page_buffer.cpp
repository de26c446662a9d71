#include "storage/formats/detail/page_buffer.h"

#include "storage/base/error.h"

namespace footwall::formats::detail {
namespace {

constexpr auto kPage = static_cast<std::int64_t>(kPageBytes);

// From `start`, which is on a page, to the end of the page that `end` is in.
std::int64_t whole_pages(std::int64_t start, std::int64_t end) {
  return (end - start + kPage - 1) / kPage * kPage;
}

}  // namespace

void PageBuffer::make_room(std::int64_t offset, std::int64_t size) {
  size_ = 0;  // holds nothing, should what follows throw
  start_ = offset / kPage * kPage;
  const auto bytes = static_cast<std::size_t>(whole_pages(start_, offset + size));
  if (bytes <= capacity_) return;
  bytes_ = nullptr;  // before the larger one is taken
  capacity_ = 0;
  bytes_ = allocate_pages(bytes);
  capacity_ = bytes;
}

bool PageBuffer::read_if_cached(const ReadOnlyFile& file, std::int64_t offset, std::int64_t size) {
  make_room(offset, size);
  if (!file.read_if_cached(offset, {bytes_.get() + (offset - start_), static_cast<std::size_t>(size)})) {
    return false;
  }
  offset_ = offset;
  size_ = size;
  return true;
}

void PageBuffer::read(const ReadOnlyFile& file, std::int64_t offset, std::int64_t size, Way way) {
  make_room(offset, size);
  const auto bytes = static_cast<std::size_t>(whole_pages(start_, offset + size));
  if (way == Way::kThroughCache) {
    file.read_at(offset, {bytes_.get() + (offset - start_), static_cast<std::size_t>(size)});
  } else if (const auto got = static_cast<std::int64_t>(file.read_pages(start_, {bytes_.get(), bytes}));
             start_ + got < offset + size) {
    throw_ended(file, start_ + got, offset + size - start_ - got);
  }
  offset_ = offset;
  size_ = size;
}

}  // namespace footwall::formats::detail
