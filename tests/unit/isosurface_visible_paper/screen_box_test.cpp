#include "engine/isosurface/visible/paper/screen_box.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/render/camera.h"

namespace footwall::isosurface {
namespace {

using render::Vec3;

const std::vector<Vec3> kCorners{{0, 0, 0}, {40, 40, 40}};

// Triangles with corners anywhere in the box are drawn inside its rectangle.
void expect_holds(const survey::Box& cells, const render::Camera& camera, unsigned seed) {
  constexpr int kWidth = 120;
  constexpr int kHeight = 80;
  const render::PixelRect box = screen_box(cells, camera.view_projection, kWidth, kHeight);
  EXPECT_TRUE(box.empty() ? box == render::PixelRect{}
                          : box.x0 >= 0 && box.y0 >= 0 && box.x1 <= kWidth && box.y1 <= kHeight);
  std::mt19937 random(seed);
  std::vector<render::Vec3f> positions;
  std::vector<render::TriangleIndices> triangles;
  for (int n = 0; n < 60; ++n) {
    std::array<float, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      // Often in the border.
      const int where = std::uniform_int_distribution<int>(0, 3)(random);
      const auto lo = static_cast<float>(cells.lo[axis]);
      const auto hi = static_cast<float>(cells.hi[axis]);
      at[axis] = where == 0 ? lo : where == 1 ? hi : std::uniform_real_distribution<float>(lo, hi)(random);
    }
    positions.emplace_back(at[0], at[1], at[2]);
    if (n >= 2) triangles.push_back({n - 2, n - 1, n});
  }
  std::vector<render::ScreenVertex> vertices(positions.size());
  render::project(camera.view_projection, positions, kWidth, kHeight, vertices);
  render::VisibilityBuffer drawn(kWidth, kHeight);
  render::rasterize(camera.view_projection, positions, vertices, triangles, 0, drawn);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (drawn.at(x, y) == render::kBackground) continue;
      ASSERT_TRUE(x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1) << x << "," << y;
    }
  }
}

TEST(ScreenBox, HoldsWhateverIsDrawnInside) {
  std::mt19937 random(1);
  const auto upto = [&](int last) { return std::uniform_int_distribution<int>(0, last)(random); };
  for (int n = 0; n < 400; ++n) {
    survey::Box cells;
    for (int axis = 0; axis < 3; ++axis) {
      cells.lo[axis] = upto(36);
      cells.hi[axis] = cells.lo[axis] + 1 + upto(3) * upto(3);
    }
    const bool perspective = n % 2 == 0;
    const render::Camera camera =
        n % 4 < 2
            ? render::Camera::look(upto(360), upto(180) - 90, 0.5 + upto(40), kCorners, 1.5, perspective)
            : render::Camera::look_at({upto(40) + 0.5, upto(40) + 0.25, upto(40) + 0.75}, {20, 20, 20.1},
                                      {0, 0, 1}, kCorners, 1.5, perspective);
    expect_holds(cells, camera, static_cast<unsigned>(n));
    if (HasFatalFailure()) return;
  }
}

TEST(ScreenBox, IsTightAndEmptyWhereNothingIsSeen) {
  const render::Camera camera = render::Camera::look(0, 0, 1, kCorners, 1.5, false);
  const render::PixelRect all = screen_box({{0, 0, 0}, {40, 40, 40}}, camera.view_projection, 120, 80);
  // 40 of the 40 / kFill that are as high as the picture.
  EXPECT_NEAR(all.y1 - all.y0, 80 * render::Camera::kFill, 2);
  EXPECT_NEAR(all.x1 - all.x0, 80 * render::Camera::kFill, 2);
  EXPECT_EQ(screen_box({{200, 0, 0}, {208, 8, 8}}, camera.view_projection, 120, 80), render::PixelRect{});
  // Behind the eye.
  const render::Camera near =
      render::Camera::look_at({20, 20, 20}, {20, 40, 20}, {0, 0, 1}, kCorners, 1.5, true);
  EXPECT_EQ(screen_box({{16, 0, 16}, {24, 8, 24}}, near.view_projection, 120, 80), render::PixelRect{});
  // Around the eye: seen all over.
  EXPECT_EQ(screen_box({{16, 16, 16}, {24, 24, 24}}, near.view_projection, 120, 80),
            (render::PixelRect{0, 0, 120, 80}));
  render::Matrix4 broken = camera.view_projection;
  broken[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(screen_box({{0, 0, 0}, {8, 8, 8}}, broken, 120, 80), (render::PixelRect{0, 0, 120, 80}));
}

}  // namespace
}  // namespace footwall::isosurface
