#include "engine/isosurface/detail/cell_masks.h"

#include <algorithm>

namespace footwall::isosurface::detail {
namespace {

constexpr int kBrickShift = 3;
constexpr int kPartShift = 1;

// A brick without a value that is not null has min = infinity and max = -infinity.
bool is_crossed(const Bricks& bricks, std::size_t brick, float isovalue) {
  return bricks.min[brick] < isovalue && isovalue <= bricks.max[brick];
}

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

CellMasks::CellMasks(const Frame& frame, const Bricks* bricks, std::span<const BrickParts> parts)
    : words_a_row_(frame.words) {
  if (bricks == nullptr) {
    words_.assign(words_a_row_ + kWordSlack, 0);
    set_bits(words_.data(), frame.cells.lo[2], frame.cells.hi[2]);
    any_.assign(1, 1);
    plane_any_.assign(1, 1);
    plane_work_.assign(1, 1);
    return;
  }
  survey::Box touched;  // bricks
  for (int axis = 0; axis < 3; ++axis) {
    touched.lo[axis] = (frame.cells.lo[axis] + frame.field->origin[axis]) >> kBrickShift;
    touched.hi[axis] = ((frame.cells.hi[axis] + frame.field->origin[axis] - 1) >> kBrickShift) + 1;
  }
  first_i_ = frame.cells.lo[0] + frame.field->origin[0] - (touched.lo[0] << kBrickShift);
  first_j_ = frame.cells.lo[1] + frame.field->origin[1] - (touched.lo[1] << kBrickShift);
  shift_ = parts.empty() ? kBrickShift : kPartShift;
  const std::int64_t columns_a_brick = std::int64_t{1} << (kBrickShift - shift_);
  columns_ = touched.size(1) * columns_a_brick;
  const std::int64_t planes = touched.size(0) * columns_a_brick;
  words_.assign(static_cast<std::size_t>(planes * columns_) * words_a_row_ + kWordSlack, 0);
  any_.assign(static_cast<std::size_t>(planes * columns_), 0);
  plane_any_.assign(static_cast<std::size_t>(planes), 0);
  constexpr double kIdleBrick = 1.0 / 64;
  plane_work_.assign(plane_any_.size(), kIdleBrick * static_cast<double>(touched.size(1) * touched.size(2)));
  if (parts.empty()) {
    take_bricks(frame, *bricks, touched);
  } else {
    take_parts(frame, *bricks, parts, touched);
  }
}

void CellMasks::take_bricks(const Frame& frame, const Bricks& bricks, const survey::Box& touched) {
  std::size_t column = 0;
  for (std::int64_t a = touched.lo[0]; a < touched.hi[0]; ++a) {
    for (std::int64_t b = touched.lo[1]; b < touched.hi[1]; ++b, ++column) {
      const auto first = static_cast<std::size_t>((a * bricks.dims[1] + b) * bricks.dims[2]);
      for (std::int64_t c = touched.lo[2]; c < touched.hi[2]; ++c) {
        if (!is_crossed(bricks, first + static_cast<std::size_t>(c), frame.isovalue)) continue;
        const std::int64_t k = (c << kBrickShift) - frame.field->origin[2];
        set_bits(words_.data() + column * words_a_row_, std::max(k, frame.cells.lo[2]),
                 std::min(k + 8, frame.cells.hi[2]));
        any_[column] = 1;
        plane_any_[static_cast<std::size_t>(a - touched.lo[0])] = 1;
        plane_work_[static_cast<std::size_t>(a - touched.lo[0])] += 1;
      }
    }
  }
}

void CellMasks::take_parts(const Frame& frame, const Bricks& bricks, std::span<const BrickParts> parts,
                           const survey::Box& touched) {
  for (std::int64_t a = touched.lo[0]; a < touched.hi[0]; ++a) {
    for (std::int64_t b = touched.lo[1]; b < touched.hi[1]; ++b) {
      const auto first = static_cast<std::size_t>((a * bricks.dims[1] + b) * bricks.dims[2]);
      for (std::int64_t c = touched.lo[2]; c < touched.hi[2]; ++c) {
        const std::size_t brick = first + static_cast<std::size_t>(c);
        if (parts[brick] == 0 || !is_crossed(bricks, brick, frame.isovalue)) continue;
        const std::int64_t k = (c << kBrickShift) - frame.field->origin[2];
        for (unsigned row = 0; row < 16; ++row) {
          const auto four = static_cast<unsigned>(parts[brick] >> (4 * row) & 15U);
          if (four == 0) continue;
          const auto plane = static_cast<std::size_t>(4 * (a - touched.lo[0]) + row / 4);
          const auto column = plane * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(4 * (b - touched.lo[1]) + row % 4);
          for (std::int64_t part = 0; part < 4; ++part) {
            if ((four >> static_cast<unsigned>(part) & 1U) == 0) continue;
            set_bits(words_.data() + column * words_a_row_, std::max(k + 2 * part, frame.cells.lo[2]),
                     std::min(k + 2 * part + 2, frame.cells.hi[2]));
          }
          any_[column] = 1;
          plane_any_[plane] = 1;
          plane_work_[plane] += 1.0 / 16;
        }
      }
    }
  }
}

}  // namespace footwall::isosurface::detail
