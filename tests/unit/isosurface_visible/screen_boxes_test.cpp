#include "engine/isosurface/visible/screen_boxes.h"

#include <gtest/gtest.h>

#include <bit>

#include "engine/isosurface/visible/active_parts.h"
#include "unit/isosurface_visible/visible_scene.h"

namespace footwall::isosurface {
namespace {

// Every point inside lands between the box's pixels and no nearer than it says.
TEST(ScreenBoxes, HoldWhateverIsInside) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> share(0, 1);
  VisibleScene scene(ball_volume({29, 30, 23}, 9));
  scene.request.placement = {{0, 12.5, 0, 25, 3, 0, 0, 0, -4}, {100, -50, 7}};
  for (int view = 0; view < 30; ++view) {
    scene.look_at_random(random);
    const ScreenBoxes boxes(scene.request.camera, scene.request.placement, kWidth, kHeight);
    const auto scale = render::DepthScale::between(0, 1);
    for (std::int64_t n = 0; n < 4 * 4 * 3; ++n) {
      const survey::Index brick{n / 12, n / 3 % 4, n % 3};
      survey::Box cells;
      for (int axis = 0; axis < 3; ++axis) {
        cells.lo[axis] = 8 * brick[axis];
        cells.hi[axis] = std::min(8 * brick[axis] + 8, scene.volume.size[axis] - 1);
      }
      const LooseBox whole = boxes.of(cells);
      std::vector<render::ScreenBox> found(64);
      const BrickParts parts = random() | std::uint64_t{random()} << 32U;
      const BrickParts kept = boxes.of_parts(cells, parts, boxes.scaled(whole, scale), scale, found.data());
      ASSERT_EQ(kept & ~parts, 0U);
      for (unsigned bit = 0; bit < 64; ++bit) {
        if ((parts >> bit & 1U) == 0) continue;
        survey::Index lo{cells.lo[0] + 2 * (bit >> 4U), cells.lo[1] + 2 * (bit >> 2U & 3U),
                         cells.lo[2] + 2 * (bit & 3U)};
        render::ScreenBox box;
        if ((kept >> bit & 1U) != 0)
          box = found[static_cast<std::size_t>(std::popcount(kept & ((BrickParts{1} << bit) - 1)))];
        for (int point = 0; point < 6; ++point) {
          std::array<float, 3> p{};
          bool is_inside = true;
          for (int axis = 0; axis < 3; ++axis) {
            is_inside = is_inside && lo[axis] < cells.hi[axis];
            const auto room = static_cast<float>(std::min<std::int64_t>(2, cells.hi[axis] - lo[axis]));
            p[static_cast<std::size_t>(axis)] =
                static_cast<float>(lo[axis]) + room * (point < 3 ? share(random) : std::round(share(random)));
          }
          if (!is_inside) continue;
          const render::ScreenVertex v = render::projected(
              render::transformed(boxes.to_clip(), render::Vec3(render::Vec3f(p[0], p[1], p[2]))), kWidth,
              kHeight);
          if (v.outside != 0) continue;
          // The pixels whose centre is the vertex, or beside it.
          const int x = v.x >> render::kSubPixelBits;
          const int y = v.y >> render::kSubPixelBits;
          const bool is_centre = (v.x & 255) == 128 && (v.y & 255) == 128;
          if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) continue;
          if (is_centre) {
            ASSERT_TRUE(box.x0 <= x && x <= box.x1 && box.y0 <= y && y <= box.y1);
          }
          if (box.empty()) continue;
          ASSERT_TRUE(box.x0 <= x + 1 && x - 1 <= box.x1 && box.y0 <= y + 1 && y - 1 <= box.y1) << view;
          ASSERT_LT(box.nearest, scale.behind(v.depth));
          ASSERT_TRUE(whole.x0 <= x + 1 && x - 1 <= whole.x1 && whole.y0 <= y + 1 && y - 1 <= whole.y1);
          ASSERT_LE(whole.nearest, v.depth + 1e-6);
          ASSERT_GE(whole.farthest, v.depth - 1e-6);
        }
      }
    }
  }
}

TEST(ActiveParts, AreThoseWithSamplesOnBothSides) {
  for (const survey::Index& size : {survey::Index{20, 18, 27}, {9, 9, 9}, {2, 12, 4}, {1, 9, 9}}) {
    const SampleVolume volume = sampled(size, [](auto i, auto j, auto k) {
      return std::sin(0.6 * static_cast<double>(i)) + std::sin(0.5 * static_cast<double>(j) + 1) +
             std::cos(0.7 * static_cast<double>(k));
    });
    const BrickRanges ranges = brick_ranges(volume.field(), 1);
    for (std::int64_t a = 0; a < ranges.dims[0]; ++a) {
      for (std::int64_t b = 0; b < ranges.dims[1]; ++b) {
        for (std::int64_t c = 0; c < ranges.dims[2]; ++c) {
          BrickParts expected = 0;
          for (unsigned bit = 0; bit < 64; ++bit) {
            const survey::Index lo{8 * a + 2 * (bit >> 4U), 8 * b + 2 * (bit >> 2U & 3U),
                                   8 * c + 2 * (bit & 3U)};
            bool below = false;
            bool above = false;
            bool has_cells = true;
            for (int axis = 0; axis < 3; ++axis) has_cells = has_cells && lo[axis] + 1 < size[axis];
            for (std::int64_t i = lo[0]; i <= std::min(lo[0] + 2, size[0] - 1); ++i) {
              for (std::int64_t j = lo[1]; j <= std::min(lo[1] + 2, size[1] - 1); ++j) {
                for (std::int64_t k = lo[2]; k <= std::min(lo[2] + 2, size[2] - 1); ++k) {
                  const float v = volume.values[static_cast<std::size_t>((i * size[1] + j) * size[2] + k)];
                  (v >= 0.3F ? above : below) = true;
                }
              }
            }
            if (has_cells && below && above) expected |= BrickParts{1} << bit;
          }
          ASSERT_EQ(active_parts(volume.field(), {a, b, c}, 0.3F), expected) << a << " " << b << " " << c;
        }
      }
    }
  }
}

}  // namespace
}  // namespace footwall::isosurface
