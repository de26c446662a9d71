#include "storage/formats/png.h"

#include <fmt/format.h>
#include <png.h>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::formats {

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgba) {
  require(width > 0 && height > 0 &&
              rgba.size() == 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "a picture has four bytes per pixel");
  refuse_to_replace_storage(path);
  PartialFile file(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGBA;
  const int written = png_image_write_to_file(&image, file.path().c_str(), 0, rgba.data(), 0, nullptr);
  const std::string reason = image.message;
  png_image_free(&image);
  if (written == 0) {
    throw Error(ErrorCode::kIo, fmt::format("cannot write the picture {}: {}", path.string(), reason),
                "check that there is room and that the folder may be written to");
  }
  file.commit();
}

}  // namespace footwall::formats
