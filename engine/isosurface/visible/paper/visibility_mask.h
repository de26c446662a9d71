// The three-valued mask of the host: 0, nothing is known to cover the pixel; 1, triangles do; 2, the box of a
// cell in this pass does. Kept as two masks of bits: `covered` is 1, `claimed` is 1 or 2.
// Based on: seed 003, section 3.2. The mask has no depth: what covers a pixel may lie behind the cell that is
// discarded for it, so that visible cells can be lost. Mode `depth` does not use it.
#pragma once
#include <cstdint>

#include "engine/render/coverage_mask.h"

namespace footwall::isosurface {

class VisibilityMask {
 public:
  VisibilityMask(int width, int height) : covered_(width, height), claimed_(width, height) {}

  enum class Outcome : std::uint8_t {
    kVisible,      // a 0 was there; the rectangle's zeros are 2 now
    kHidden,       // all 1, or outside of the picture
    kUndetermined  // no 0, but a 2
  };
  Outcome classify(const render::PixelRect& box) {
    if (!claimed_.covers(box)) {
      claimed_.fill(box);
      return Outcome::kVisible;
    }
    return covered_.covers(box) ? Outcome::kHidden : Outcome::kUndetermined;
  }
  // Entries 2. After the last cell was classified: pixels that cells not yet extracted may still cover.
  std::int64_t claimed_pixels() const { return covered_.uncovered() - claimed_.uncovered(); }
  // Makes 2 to 0, then 1 of what `covered` covers, too.
  void end_pass(const render::CoverageMask& covered) {
    covered_.merge(0, covered.tiles(0, covered.tile_rows()));
    claimed_ = covered_;
  }

 private:
  render::CoverageMask covered_;
  render::CoverageMask claimed_;
};

}  // namespace footwall::isosurface
