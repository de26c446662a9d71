#include "engine/isosurface/detail/cell_masks.h"

#include <algorithm>

namespace footwall::isosurface::detail {
namespace {

constexpr int kBrickShift = 3;

void set_bits(std::uint64_t* words, std::int64_t from, std::int64_t to) {
  for (std::int64_t at = from; at < to;) {
    const std::int64_t end = std::min(to, (at / 64 + 1) * 64);
    const auto bits = static_cast<unsigned>(end - at);
    const std::uint64_t run = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    words[at / 64] |= run << static_cast<unsigned>(at % 64);
    at = end;
  }
}

}  // namespace

CellMasks::CellMasks(const Frame& frame, const Bricks* bricks) : words_a_row_(frame.words) {
  if (bricks == nullptr) {
    words_.assign(words_a_row_ + kWordSlack, 0);
    set_bits(words_.data(), frame.cells.lo[2], frame.cells.hi[2]);
    any_.assign(1, 1);
    plane_any_.assign(1, 1);
    cells_ = static_cast<std::uint64_t>(frame.cells.size(0) * frame.cells.size(1) * frame.cells.size(2));
    return;
  }
  shift_ = kBrickShift;
  survey::Box touched;  // bricks
  for (int axis = 0; axis < 3; ++axis) {
    touched.lo[axis] = (frame.cells.lo[axis] + frame.field->origin[axis]) >> kBrickShift;
    touched.hi[axis] = ((frame.cells.hi[axis] + frame.field->origin[axis] - 1) >> kBrickShift) + 1;
  }
  first_i_ = frame.cells.lo[0] + frame.field->origin[0] - (touched.lo[0] << kBrickShift);
  first_j_ = frame.cells.lo[1] + frame.field->origin[1] - (touched.lo[1] << kBrickShift);
  columns_ = touched.size(1);
  const auto count = static_cast<std::size_t>(touched.size(0) * columns_);
  words_.assign(count * words_a_row_ + kWordSlack, 0);
  any_.assign(count, 0);
  plane_any_.assign(static_cast<std::size_t>(touched.size(0)), 0);
  std::size_t column = 0;
  for (std::int64_t a = touched.lo[0]; a < touched.hi[0]; ++a) {
    for (std::int64_t b = touched.lo[1]; b < touched.hi[1]; ++b, ++column) {
      const auto first = static_cast<std::size_t>((a * bricks->dims[1] + b) * bricks->dims[2]);
      for (std::int64_t c = touched.lo[2]; c < touched.hi[2]; ++c) {
        const std::size_t brick = first + static_cast<std::size_t>(c);
        // A brick without a value that is not null has min = infinity and max = -infinity.
        if (!(bricks->min[brick] < frame.isovalue && frame.isovalue <= bricks->max[brick])) continue;
        const std::int64_t k = (c << kBrickShift) - frame.field->origin[2];
        set_bits(words_.data() + column * words_a_row_, std::max(k, frame.cells.lo[2]),
                 std::min(k + 8, frame.cells.hi[2]));
        any_[column] = 1;
        plane_any_[static_cast<std::size_t>(a - touched.lo[0])] = 1;
        cells_ += std::uint64_t{1} << (3 * kBrickShift);
      }
    }
  }
}

}  // namespace footwall::isosurface::detail
