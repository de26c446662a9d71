// Numbers for triangles of which only some are ever made: ascending as in the whole surface, so that of two
// triangles at the same depth the same one is seen, and known without counting any. Each row of cells of each
// brick that the isovalue crosses has room for as many triangles as it could have.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/extract.h"
#include "engine/render/visibility.h"

namespace footwall::isosurface {

class BrickNumbers {
 public:
  // Throws Error kUnsupported where the numbers do not fit into 32 bits: from 699,050 crossed bricks on.
  BrickNumbers(const Bricks& bricks, float isovalue);
  BrickNumbers() = default;

  // Of the first triangle of two cells of a crossed brick; run.first_triangle is not looked at.
  render::PrimitiveId first_of(const PartRun& run) const;

 private:
  survey::Index dims_{0, 0, 0};
  std::vector<std::uint32_t> order_;    // [a][b][c]: crossed bricks before it in its column (a, b)
  std::vector<std::uint64_t> columns_;  // [a][b]: those of earlier columns; one more at the end
};

}  // namespace footwall::isosurface
