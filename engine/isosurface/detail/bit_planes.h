// A bit for every sample of a few planes: whether it is inside.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/detail/cell_masks.h"
#include "engine/isosurface/detail/lines_ahead.h"

namespace footwall::isosurface::detail {

// The planes that were scanned last. Only words with samples of cells to be looked at are written; of the
// others, and of bits beyond a row's end, nothing is known. The word after a row's last can be read.
class BitPlanes {
 public:
  static constexpr std::int64_t kPlanes = 4;

  explicit BitPlanes(const Frame& frame);

  // Takes the place of plane p - kPlanes. Where parts of rows are left out, `ahead` gets what the next plane
  // is likely to need.
  void scan(const Frame& frame, const CellMasks& masks, std::int64_t p, LinesAhead& ahead);

  // Of the row of samples (p, r) of the frame, frame.words words. Inside: v >= isovalue.
  const std::uint64_t* inside(std::int64_t p, std::int64_t r) const {
    return inside_.data() + row(p, r) * words_;
  }
  bool has_null(std::int64_t p, std::int64_t r) const { return has_null_[row(p, r)] != 0; }
  // Not null; of rows with a null only.
  const std::uint64_t* known(std::int64_t p, std::int64_t r) const {
    return known_.data() + row(p, r) * words_;
  }

  // For scan().
  struct Row {
    std::uint64_t* inside;
    std::uint64_t* known;
    std::uint8_t* has_null;
  };
  Row row_to_scan(std::int64_t p, std::int64_t r) {
    return {inside_.data() + row(p, r) * words_, known_.data() + row(p, r) * words_,
            has_null_.data() + row(p, r)};
  }

 private:
  std::size_t row(std::int64_t p, std::int64_t r) const {
    return static_cast<std::size_t>((p % kPlanes) * rows_ + r);
  }

  std::int64_t rows_;
  std::size_t words_;
  std::vector<std::uint64_t> inside_;
  std::vector<std::uint64_t> known_;
  std::vector<std::uint8_t> has_null_;
};

}  // namespace footwall::isosurface::detail
