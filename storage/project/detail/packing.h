// Arrays as little-endian blobs, and back; and zlib around them. A blob from a file is never trusted: its
// size is held against the count that the caller states before anything is allocated.
#pragma once
#include <bit>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "storage/project/records.h"

namespace footwall::project::detail {

static_assert(std::endian::native == std::endian::little, "blobs are little-endian");

template <class T>
void append(Bytes& to, std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = to.size();
  to.resize(at + values.size_bytes());
  if (!values.empty()) std::memcpy(to.data() + at, values.data(), values.size_bytes());
}

template <class T>
Bytes packed(const std::vector<T>& values) {
  Bytes bytes;
  append(bytes, std::span<const T>(values));
  return bytes;
}

// Error kCorrupt: "<what> has <found> bytes, expected <expected>".
[[noreturn]] void throw_wrong_size(std::string_view what, std::size_t found, std::size_t expected);

// Throws kCorrupt unless `bytes` holds exactly `count` elements of `element_size` bytes.
void require_size(std::string_view what, std::size_t found, std::int64_t count, std::size_t element_size);

// The next `count` values of `from`, which is shortened by them; sizes must have been checked before.
template <class T>
std::vector<T> taken(std::span<const std::byte>& from, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (from.size() < count * sizeof(T)) throw_wrong_size("a stored array", from.size(), count * sizeof(T));
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), from.data(), count * sizeof(T));
  from = from.subspan(count * sizeof(T));
  return values;
}

// zlib, fast level.
Bytes compressed(std::span<const std::byte> bytes);
// Throws kCorrupt unless it unpacks to exactly `size` bytes, and before allocating where zlib cannot reach
// that size.
Bytes uncompressed(std::span<const std::byte> bytes, std::size_t size, std::string_view what);

}  // namespace footwall::project::detail
