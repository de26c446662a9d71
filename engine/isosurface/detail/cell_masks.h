// Which cells are to be looked at, a bit each: those of the box, in bricks that the isovalue can cross.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/detail/frame.h"

namespace footwall::isosurface::detail {

class CellMasks {
 public:
  // bricks may be null: then all cells of the box. parts: as in ExtractOptions.
  CellMasks(const Frame& frame, const Bricks* bricks, std::span<const BrickParts> parts);

  // The words of the row of cells (p, r) of the frame; null where no cell is to be looked at.
  const std::uint64_t* row(std::int64_t p, std::int64_t r) const {
    const std::int64_t column = ((first_i_ + p) >> shift_) * columns_ + ((first_j_ + r) >> shift_);
    return any_[static_cast<std::size_t>(column)] == 0
               ? nullptr
               : words_.data() + static_cast<std::size_t>(column) * words_a_row_;
  }
  // Whether no cell of the plane p is.
  bool plane_is_empty(std::int64_t p) const {
    return plane_any_[static_cast<std::size_t>((first_i_ + p) >> shift_)] == 0;
  }

  // How much work the plane is, in some unit: the bricks to be looked at, and a little for the others.
  double work(std::int64_t p) const {
    return plane_work_[static_cast<std::size_t>((first_i_ + p) >> shift_)];
  }

 private:
  void take_bricks(const Frame& frame, const Bricks& bricks, const survey::Box& touched);
  void take_parts(const Frame& frame, const Bricks& bricks, std::span<const BrickParts> parts,
                  const survey::Box& touched);

  std::int64_t first_i_ = 0;  // of the frame, counted from the first brick that it touches
  std::int64_t first_j_ = 0;
  int shift_ = 62;  // rows of so many bits of i and j are alike; without bricks all of them
  std::int64_t columns_ = 1;
  std::size_t words_a_row_ = 0;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint8_t> any_;
  std::vector<std::uint8_t> plane_any_;
  std::vector<double> plane_work_;
};

}  // namespace footwall::isosurface::detail
