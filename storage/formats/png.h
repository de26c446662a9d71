// Pictures as PNG files, through libpng.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

namespace footwall::formats {

// rgba: 4 * width * height bytes (red, green, blue, alpha), row 0 on top, sRGB. The file takes its name only
// when it is whole. Throws Error kNotFound without the folder, kIo with libpng's reason, kInternal for a span
// of another size.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace footwall::formats
