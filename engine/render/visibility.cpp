#include "engine/render/visibility.h"

#include <fmt/format.h>

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::render {

VisibilityBuffer::VisibilityBuffer(int width, int height, int first_row, int rows)
    : width_(width), height_(height), first_row_(first_row), rows_(rows) {
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    throw Error(ErrorCode::kUsage, fmt::format("a picture of {} x {} pixels cannot be drawn", width, height),
                fmt::format("give 1 to {} pixels each way", kLargest));
  }
  if (first_row < 0 || rows < 1 || rows > height - first_row) {
    throw Error(ErrorCode::kUsage, fmt::format("rows {} to {} are not in a picture of {} rows", first_row,
                                               std::int64_t{first_row} + rows - 1, height));
  }
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) + kSpare, kBackground);
}

void VisibilityBuffer::clear() {
  std::fill(pixels_.begin(), pixels_.end(), kBackground);
}

void VisibilityBuffer::clear(int begin, int end, int first, int last) {
  for (int y = first; y < last; ++y) {
    const std::span<Visible> columns =
        row(y).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    std::fill(columns.begin(), columns.end(), kBackground);
  }
}

void VisibilityBuffer::merge(const VisibilityBuffer& other) {
  require(width_ == other.width_ && height_ == other.height_ && first_row_ == other.first_row_ &&
              rows_ == other.rows_,
          "only pictures of the same window can be merged");
  for (std::size_t n = 0; n < pixels_.size(); ++n) pixels_[n] = std::min(pixels_[n], other.pixels_[n]);
}

}  // namespace footwall::render
