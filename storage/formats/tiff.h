// TIFF of one float32 per pixel, for depth: little endian, one strip, not compressed (TIFF 6.0, sections 3
// and 19).
#pragma once
#include <filesystem>
#include <span>

namespace footwall::formats {

// values: width * height, row 0 on top. Throws Error kInvalid for more than 4 GB of values, kIo; replaces a
// file only when the new one is whole, and refuses to replace a project or volume.
void write_tiff(const std::filesystem::path& path, int width, int height, std::span<const float> values);

}  // namespace footwall::formats
