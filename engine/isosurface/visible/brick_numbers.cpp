#include "engine/isosurface/visible/brick_numbers.h"

#include <fmt/format.h>

#include "engine/isosurface/case_tables.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr std::uint64_t kOfRow = 8 * kMostTrianglesOfCell;
constexpr std::uint64_t kOfPart = 2 * kMostTrianglesOfCell;
constexpr std::uint64_t kOfBrick = 64 * kOfRow;

}  // namespace

BrickNumbers::BrickNumbers(const Bricks& bricks, float isovalue) : dims_(bricks.dims) {
  order_.resize(bricks.min.size());
  columns_.reserve(static_cast<std::size_t>(dims_[0] * dims_[1]) + 1);
  std::uint64_t crossed = 0;
  std::size_t brick = 0;
  for (std::int64_t column = 0; column < dims_[0] * dims_[1]; ++column) {
    columns_.push_back(crossed);
    std::uint32_t before = 0;
    for (std::int64_t c = 0; c < dims_[2]; ++c, ++brick) {
      order_[brick] = before;
      before += bricks.min[brick] < isovalue && isovalue <= bricks.max[brick] ? 1 : 0;
    }
    crossed += before;
  }
  columns_.push_back(crossed);
  if (crossed * kOfBrick >= render::kNoPrimitive) {
    throw Error(
        ErrorCode::kUnsupported,
        fmt::format("only what can be seen cannot be drawn of {} bricks that the isovalue crosses", crossed),
        fmt::format("at most {} are possible; draw the whole isosurface", render::kNoPrimitive / kOfBrick));
  }
}

render::PrimitiveId BrickNumbers::first_of(const PartRun& run) const {
  const std::int64_t a = run.i / 8;
  const std::int64_t b = run.j / 8;
  const auto column = static_cast<std::size_t>(a * dims_[1] + b);
  const auto slab = static_cast<std::size_t>(a * dims_[1]);
  const std::uint64_t in_slab = columns_[slab + static_cast<std::size_t>(dims_[1])] - columns_[slab];
  const std::uint64_t in_column = columns_[column + 1] - columns_[column];
  // The planes i of the slab one after the other, in each the rows j of its columns.
  const std::uint64_t rows =
      64 * columns_[slab] + static_cast<std::uint64_t>(run.i % 8) * 8 * in_slab +
      8 * (columns_[column] - columns_[slab]) + static_cast<std::uint64_t>(run.j % 8) * in_column +
      order_[column * static_cast<std::size_t>(dims_[2]) + static_cast<std::size_t>(run.part / 4)];
  return static_cast<render::PrimitiveId>(rows * kOfRow + static_cast<std::uint64_t>(run.part % 4) * kOfPart);
}

}  // namespace footwall::isosurface
