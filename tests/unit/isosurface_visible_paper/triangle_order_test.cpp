#include "engine/isosurface/visible/paper/triangle_order.h"

#include <gtest/gtest.h>

#include "engine/isosurface/brick_ranges.h"
#include "storage/base/error.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

TEST(TriangleOrder, AscendsWithRoomForEveryCell) {
  const survey::Index size{19, 28, 35};
  const SampleVolume volume = ball_volume(size, 8);
  const BrickRanges bricks = brick_ranges(volume.field(), 1);
  const TriangleOrder order(bricks.tables(), 0);
  std::uint64_t next = 0;
  for (std::int64_t i = 0; i + 1 < size[0]; ++i) {
    for (std::int64_t j = 0; j + 1 < size[1]; ++j) {
      for (std::int64_t k = 0; k + 1 < size[2]; ++k) {
        const auto brick =
            static_cast<std::size_t>((i / 8 * bricks.dims[1] + j / 8) * bricks.dims[2] + k / 8);
        if (!(bricks.min[brick] < 0 && 0 <= bricks.max[brick])) continue;
        ASSERT_GE(order.first(i, j, k), next) << i << " " << j << " " << k;
        next = order.first(i, j, k) + TriangleOrder::kRoom;
      }
    }
  }
  EXPECT_GT(next, 0U);
}

TEST(TriangleOrder, RefusesMoreBricksThanNumbers) {
  constexpr std::size_t kCount = 81 * 81 * 81;
  const std::vector<float> min(kCount, -1);
  const std::vector<float> max(kCount, 1);
  const std::vector<std::uint8_t> nulls(kCount, 0);
  const Bricks bricks{{81, 81, 81}, min, max, nulls};
  EXPECT_THROW(TriangleOrder(bricks, 0), Error);
  EXPECT_EQ(TriangleOrder(bricks, 2).first(0, 0, 0), 0U) << "none is crossed";
}

}  // namespace
}  // namespace footwall::isosurface
