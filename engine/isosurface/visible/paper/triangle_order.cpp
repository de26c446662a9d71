#include "engine/isosurface/visible/paper/triangle_order.h"

#include "engine/isosurface/visible/octree.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kBrick = kBrickCells[0];

}  // namespace

TriangleOrder::TriangleOrder(const Bricks& bricks, float isovalue) : dims_(bricks.dims) {
  std::uint64_t all = 0;  // rows of cells in crossed bricks
  std::size_t brick = 0;
  for (std::int64_t a = 0; a < dims_[0]; ++a) {
    plane_first_.push_back(all);
    std::uint64_t plane = 0;
    for (std::int64_t b = 0; b < dims_[1]; ++b) {
      Column column{plane, 0};
      for (std::int64_t c = 0; c < dims_[2]; ++c, ++brick) {
        const bool crossed = bricks.min[brick] < isovalue && isovalue <= bricks.max[brick];
        below_.push_back(column.crossed);
        crossed_.push_back(crossed ? 1 : 0);
        column.crossed += crossed ? 1 : 0;
      }
      plane += column.crossed * static_cast<std::uint64_t>(kBrick);
      columns_.push_back(column);
    }
    plane_.push_back(plane);
    all += plane * static_cast<std::uint64_t>(kBrick);
  }
  if (all * kBrick * kRoom > render::kNoPrimitive) {
    throw Error(ErrorCode::kUnsupported, "the isosurface crosses too many bricks for one picture",
                "choose another isovalue, or crop the volume");
  }
}

render::PrimitiveId TriangleOrder::first(std::int64_t i, std::int64_t j, std::int64_t k) const {
  const std::int64_t a = i / kBrick;
  const std::int64_t b = j / kBrick;
  const Column& in = column(a, b);
  const auto brick = static_cast<std::size_t>((a * dims_[1] + b) * dims_[2] + k / kBrick);
  const auto at = static_cast<std::size_t>(a);
  const std::uint64_t row = plane_first_[at] + static_cast<std::uint64_t>(i % kBrick) * plane_[at] +
                            in.before + static_cast<std::uint64_t>(j % kBrick) * in.crossed + below_[brick];
  // What begins in a brick without triangles has its first one in the next brick that has some.
  const auto inside = static_cast<std::uint64_t>(crossed_[brick] != 0 ? k % kBrick : 0);
  return static_cast<render::PrimitiveId>((row * kBrick + inside) * kRoom);
}

}  // namespace footwall::isosurface
