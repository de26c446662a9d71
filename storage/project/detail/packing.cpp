#include "storage/project/detail/packing.h"

#include <zlib.h>

#include <fmt/format.h>

#include "storage/base/error.h"

namespace footwall::project::detail {

void throw_wrong_size(std::string_view what, std::size_t found, std::size_t expected) {
  throw Error(ErrorCode::kCorrupt, fmt::format("{} has {} bytes, expected {}", what, found, expected),
              "the project is damaged: restore it from a copy");
}

void require_size(std::string_view what, std::size_t found, std::int64_t count, std::size_t element_size) {
  // Compared by division: a hostile count must not overflow a product.
  const bool fits =
      count >= 0 && found % element_size == 0 && found / element_size == static_cast<std::uint64_t>(count);
  if (!fits) throw_wrong_size(what, found, static_cast<std::size_t>(count) * element_size);
}

Bytes compressed(std::span<const std::byte> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  Bytes out(size);
  const int rc = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                           reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 1);
  require(rc == Z_OK, "zlib could not compress");
  out.resize(size);
  return out;
}

Bytes uncompressed(std::span<const std::byte> bytes, std::size_t size, std::string_view what) {
  constexpr std::size_t kBestRatio = 1040;  // deflate reaches 1032 at most
  if (size / kBestRatio > bytes.size()) throw_wrong_size(what, bytes.size(), size);
  Bytes out(size);
  // zlib refuses a null pointer even where there is nothing to write.
  std::byte nothing{};
  uLongf written = static_cast<uLongf>(size);
  const int rc = uncompress(reinterpret_cast<Bytef*>(size == 0 ? &nothing : out.data()), &written,
                            reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  if (rc != Z_OK || written != size) throw_wrong_size(what, written, size);
  return out;
}

}  // namespace footwall::project::detail
