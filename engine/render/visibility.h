// The visibility buffer: per pixel one number that says what is seen there and how far away it is.
// Based on: algorithms section 2, "pixel = u64 (depth32 << 32 | primitive id)". Merging two pictures of parts
// of a scene is the unsigned minimum, which is associative, commutative and decides ties by id: any order of
// any parts gives the same bits.
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace footwall::render {

using Visible = std::uint64_t;
using PrimitiveId = std::uint32_t;

inline constexpr PrimitiveId kNoPrimitive = 0xffffffffU;
// depth: OpenGL window depth in [0, 1]; its bits order as the numbers do.
constexpr Visible visible(float depth, PrimitiveId id) {
  return static_cast<Visible>(std::bit_cast<std::uint32_t>(depth)) << 32U | id;
}
constexpr float depth_of(Visible v) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(v >> 32U));
}
constexpr PrimitiveId primitive_of(Visible v) {
  return static_cast<PrimitiveId>(v);
}
inline constexpr Visible kBackground = visible(1.0F, kNoPrimitive);

// A window of a whole picture of `width` x `height` pixels: rows [first_row, first_row + rows), all columns.
// Row 0 is on top. What lands in a pixel does not depend on the window that it is drawn through.
class VisibilityBuffer {
 public:
  VisibilityBuffer(int width, int height) : VisibilityBuffer(width, height, 0, height) {}
  // Throws Error kUsage unless 1 <= width, height <= kLargest and the rows lie inside.
  VisibilityBuffer(int width, int height, int first_row, int rows);
  static constexpr int kLargest = 32768;

  int width() const { return width_; }
  int height() const { return height_; }
  int first_row() const { return first_row_; }
  int rows() const { return rows_; }
  std::span<Visible> row(int y) {
    return std::span(pixels_).subspan(
        static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_),
        static_cast<std::size_t>(width_));
  }
  std::span<const Visible> row(int y) const {
    return std::span(pixels_).subspan(
        static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_),
        static_cast<std::size_t>(width_));
  }
  Visible at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  std::span<Visible> pixels() { return std::span(pixels_).first(count()); }
  std::span<const Visible> pixels() const { return std::span(pixels_).first(count()); }
  // So many pixels beyond the last may be read and written back by loops that take several at once.
  static constexpr std::size_t kSpare = 16;
  void clear();
  // Of columns [begin, end) in the rows [first, last) alone, which must lie inside.
  void clear(int begin, int end, int first, int last);
  // Keeps the nearer of each pixel. Throws kInternal if the windows differ.
  void merge(const VisibilityBuffer& other);

 private:
  std::size_t count() const { return pixels_.size() - kSpare; }

  int width_;
  int height_;
  int first_row_;
  int rows_;
  std::vector<Visible> pixels_;
};

}  // namespace footwall::render
