#include "storage/formats/tiff.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <fstream>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::formats {
namespace {

// Of an entry of the directory.
enum Type : std::uint16_t { kShort = 3, kLong = 4, kRational = 5 };

class Bytes {
 public:
  void short_word(std::uint16_t v) {
    for (unsigned n = 0; n < 2; ++n) bytes_.push_back(static_cast<char>(v >> 8 * n & 255U));
  }
  void long_word(std::uint32_t v) {
    for (unsigned n = 0; n < 4; ++n) bytes_.push_back(static_cast<char>(v >> 8 * n & 255U));
  }
  // One value; a short one stands in the first bytes.
  void entry(std::uint16_t tag, Type type, std::uint32_t value) {
    short_word(tag);
    short_word(type);
    long_word(1);
    if (type == kShort) {
      short_word(static_cast<std::uint16_t>(value));
      short_word(0);
    } else {
      long_word(value);
    }
  }
  const std::vector<char>& all() const { return bytes_; }

 private:
  std::vector<char> bytes_;
};

// Header, directory and the resolutions that it points to: all that stands before the values.
std::vector<char> head_of(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint16_t kEntries = 14;
  constexpr std::uint32_t kRationals = 8 + 2 + 12 * kEntries + 4;
  constexpr std::uint32_t kValues = kRationals + 16;
  Bytes head;
  head.short_word(0x4949);
  head.short_word(42);
  head.long_word(8);
  head.short_word(kEntries);
  head.entry(256, kLong, width);
  head.entry(257, kLong, height);
  head.entry(258, kShort, 32);      // bits of a sample
  head.entry(259, kShort, 1);       // not compressed
  head.entry(262, kShort, 1);       // small values are dark
  head.entry(273, kLong, kValues);  // where the strip is
  head.entry(274, kShort, 1);       // row 0 on top
  head.entry(277, kShort, 1);       // samples of a pixel
  head.entry(278, kLong, height);   // rows of the strip
  head.entry(279, kLong, width * height * 4);
  head.entry(282, kRational, kRationals);
  head.entry(283, kRational, kRationals + 8);
  head.entry(296, kShort, 1);  // the resolution has no unit
  head.entry(339, kShort, 3);  // IEEE floating point
  head.long_word(0);           // no further directory
  for (int n = 0; n < 2; ++n) {
    head.long_word(1);
    head.long_word(1);
  }
  return head.all();
}

}  // namespace

void write_tiff(const std::filesystem::path& path, int width, int height, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");
  require(width > 0 && height > 0 &&
              values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "a picture has one value per pixel");
  if (values.size_bytes() > 0xf0000000U) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} x {} values are too many for a TIFF", width, height),
                "make a smaller picture");
  }
  refuse_to_replace_storage(path);
  PartialFile file(path);
  {
    std::ofstream out(file.path(), std::ios::binary);
    const std::vector<char> head =
        head_of(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    out.write(head.data(), static_cast<std::streamsize>(head.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size_bytes()));
    out.flush();
    if (!out) throw io_error("write", path.string(), errno);
  }
  file.commit();
}

}  // namespace footwall::formats
