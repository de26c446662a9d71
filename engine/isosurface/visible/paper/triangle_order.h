// Numbers for triangles of a surface of which only parts are known, in the order that they have in the whole
// (surface.h): with gaps, but where two triangles are equally near, the same one is seen.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/extract.h"
#include "engine/render/visibility.h"

namespace footwall::isosurface {

// Every cell in a brick that the isovalue can cross has kRoom numbers, ascending by (i, j, k): plain
// arithmetic on the tables, alike on all ranks.
class TriangleOrder {
 public:
  // Throws Error kUnsupported where the numbers do not suffice: more than about half a million bricks.
  TriangleOrder(const Bricks& bricks, float isovalue);

  // More than a cell's triangles.
  static constexpr std::uint64_t kRoom = 16;
  // The first number of the cells (i, j, k), (i, j, k + 1), ... in a brick that may be crossed.
  render::PrimitiveId first(std::int64_t i, std::int64_t j, std::int64_t k) const;

 private:
  struct Column {
    std::uint64_t before =
        0;  // crossed bricks in rows of cells before this column's, in its first plane of cells
    std::uint32_t crossed = 0;
  };
  const Column& column(std::int64_t a, std::int64_t b) const {
    return columns_[static_cast<std::size_t>(a * dims_[1] + b)];
  }

  survey::Index dims_;
  std::vector<std::uint64_t>
      plane_first_;                    // of each plane of bricks: crossed bricks in planes of cells before
  std::vector<std::uint64_t> plane_;   // the same in one plane of cells
  std::vector<Column> columns_;        // [a][b]
  std::vector<std::uint32_t> below_;   // [a][b][c]: crossed bricks of the column before this one
  std::vector<std::uint8_t> crossed_;  // [a][b][c]
};

}  // namespace footwall::isosurface
