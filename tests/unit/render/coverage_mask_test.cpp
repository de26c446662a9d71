#include "engine/render/coverage_mask.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <random>

#include "engine/render/camera.h"
#include "engine/verify/covered_by_definition.h"
#include "storage/base/error.h"
#include "unit/render/sample_surfaces.h"

namespace footwall::render {
namespace {

using Random = std::mt19937;

int between(Random& random, int lo, int hi) {
  return std::uniform_int_distribution<int>(lo, hi)(random);
}

PixelRect rect_of(Random& random, int size) {
  const int x = between(random, -5, size + 5);
  const int y = between(random, -5, size + 5);
  return {x, y, x + between(random, 0, size), y + between(random, 0, size / 2)};
}

void expect_same(const CoverageMask& mask, const verify::CoveredPixels& want, Random& random) {
  ASSERT_EQ(mask.uncovered(), want.uncovered());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x)
      ASSERT_EQ(mask.covered(x, y), want.entry(x, y) != 0) << x << "," << y;
  }
  for (int n = 0; n < 60; ++n) {
    const PixelRect rect = rect_of(random, mask.width());
    ASSERT_EQ(mask.covers(rect), want.covers(rect.x0, rect.y0, rect.x1, rect.y1))
        << rect.x0 << "," << rect.y0 << " to " << rect.x1 << "," << rect.y1;
  }
}

TEST(CoverageMask, RectanglesAreThoseOfTheSlowDefinition) {
  Random random(1);
  for (const auto& [width, height] :
       {std::pair{1, 1}, {8, 8}, {9, 7}, {64, 64}, {65, 130}, {130, 65}, {521, 3}}) {
    CoverageMask mask(width, height);
    verify::CoveredPixels want(width, height);
    expect_same(mask, want, random);
    for (int n = 0; n < 20; ++n) {
      const PixelRect rect = rect_of(random, std::max(width, height) / 2);
      mask.fill(rect);
      want.fill(rect.x0, rect.y0, rect.x1, rect.y1);
      expect_same(mask, want, random);
      if (HasFatalFailure()) return;
    }
    mask.fill({0, 0, width, height});
    EXPECT_EQ(mask.uncovered(), 0);
    EXPECT_TRUE(mask.covers({-3, -3, width + 9, height + 9}));
    mask.clear();
    EXPECT_EQ(mask.uncovered(), std::int64_t{width} * height);
    EXPECT_FALSE(mask.covers({width - 1, height - 1, width, height}));
    EXPECT_TRUE(mask.covers({width, 0, width + 4, 4})) << "nothing of it is in the picture";
  }
}

// Positions that are often exactly on pixel centres and borders, where the fill rule decides.
ScreenVertex vertex(Random& random, int lo_pixel, int hi_pixel) {
  const int grain = between(random, 0, 1) == 0 ? 1 : kSubPixels / 2;
  ScreenVertex v;
  v.x = between(random, lo_pixel * kSubPixels / grain, hi_pixel * kSubPixels / grain) * grain;
  v.y = between(random, lo_pixel * kSubPixels / grain, hi_pixel * kSubPixels / grain) * grain;
  return v;
}

void cover_both(const std::array<ScreenVertex, 3>& t, CoverageMask& mask, verify::CoveredPixels& want) {
  cover_screen(t[0], t[1], t[2], mask);
  want.cover({t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}, kSubPixels);
}

TEST(CoverageMask, TrianglesCoverWhatTheDefinitionSays) {
  Random random(2);
  for (int n = 0; n < 3000; ++n) {
    CoverageMask mask(43, 35);
    verify::CoveredPixels want(43, 35);
    const int reach = n % 3 == 0 ? 4 : n % 3 == 1 ? 50 : kGuardBand / 2;
    ScreenVertex a = vertex(random, -6, 46);
    for (int more = n % 5 == 0 ? 6 : 1; more > 0; --more) {
      ScreenVertex b = vertex(random, -reach, reach);
      ScreenVertex c = vertex(random, -reach, reach);
      if (reach == 4) {
        b.x += a.x;
        b.y += a.y;
        c.x += a.x;
        c.y += a.y;
      }
      cover_both({a, b, c}, mask, want);
      a = vertex(random, -6, 46);
    }
    expect_same(mask, want, random);
    if (HasFatalFailure()) return;
  }
}

TEST(CoverageMask, AMeshCoversThePixelsThatItIsDrawnOn) {
  // Of triangles of many pixels, and of few or none.
  const OwnedSurface balls[] = {sample::ball(40, 0), sample::ball(200, 0)};
  for (int n = 0; n < 4; ++n) {
    const OwnedSurface& ball = balls[n / 2];
    const bool perspective = n % 2 == 0;
    for (const double zoom : {0.7, 3.0, 40.0}) {
      Camera camera = Camera::look(40, 20, zoom, Bounds{{-1, -1, -1}, {1, 1, 1}}, 1.5, perspective);
      // Inside of the ball, so that triangles have to be clipped.
      if (perspective && zoom > 10)
        camera = Camera::look_at({0.2, 0.3, 0.1}, {1, 0, 0}, {0, 0, 1},
                                 std::vector<Vec3>{{-1, -1, -1}, {1, 1, 1}}, 1.5, true);
      for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        std::vector<ScreenVertex> vertices(ball.positions.size());
        project(camera.view_projection, ball.positions, 150, 100, vertices);
        VisibilityBuffer drawn(150, 100);
        rasterize(camera.view_projection, ball.positions, vertices, ball.triangles, 0, drawn);
        CoverageMask mask(150, 100);
        cover(camera.view_projection, ball.positions, vertices, ball.triangles, mask);
        for (int y = 0; y < 100; ++y) {
          for (int x = 0; x < 150; ++x)
            ASSERT_EQ(mask.covered(x, y), drawn.at(x, y) != kBackground) << x << "," << y << " zoom " << zoom;
        }
      }
      hwy::SetSupportedTargetsForTest(0);
    }
  }
}

TEST(CoverageMask, SmallTrianglesCoverWhatTheDefinitionSays) {
  Random random(4);
  for (int round = 0; round < 40; ++round) {
    const int width = between(random, 1, 40);
    const int height = between(random, 1, 40);
    // Corners as a mesh has them, with whatever place they are projected from: none is clipped.
    std::vector<ScreenVertex> vertices;
    std::vector<TriangleIndices> triangles;
    for (std::int32_t n = 0; n < 600; n += 3) {
      const ScreenVertex a = vertex(random, -4, 44);
      for (int corner = 0; corner < 3; ++corner) {
        ScreenVertex v = a;
        v.x += between(random, -2, 2) * kSubPixels / 2 + between(random, -1, 1) * between(random, 0, 300);
        v.y += between(random, -2, 2) * kSubPixels / 2 + between(random, -1, 1) * between(random, 0, 300);
        vertices.push_back(v);
      }
      triangles.push_back({n, n + 1, n + 2});
    }
    verify::CoveredPixels want(width, height);
    for (const TriangleIndices& t : triangles) {
      const auto at = [&](std::size_t n) {
        const ScreenVertex& v = vertices[static_cast<std::size_t>(t[n])];
        return verify::RasterPoint{v.x, v.y};
      };
      want.cover(at(0), at(1), at(2), kSubPixels);
    }
    const std::vector<Vec3f> positions(vertices.size());
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      // One by one, so that nothing hides behind another one, and all at once.
      CoverageMask mask(width, height);
      cover({}, positions, vertices, triangles, mask);
      expect_same(mask, want, random);
      for (std::size_t n = 0; n < triangles.size(); n += 7) {
        CoverageMask alone(width, height);
        CoverageMask screen(width, height);
        cover({}, positions, vertices, std::span(triangles).subspan(n, 1), alone);
        const TriangleIndices& t = triangles[n];
        cover_screen(vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                     vertices[static_cast<std::size_t>(t[2])], screen);
        const auto got = alone.tiles(0, alone.tile_rows());
        const auto same = screen.tiles(0, screen.tile_rows());
        ASSERT_TRUE(std::equal(got.begin(), got.end(), same.begin(), same.end())) << "triangle " << n;
      }
    }
    hwy::SetSupportedTargetsForTest(0);
    if (HasFatalFailure()) return;
  }
}

TEST(CoverageMask, MergesRowsOfTilesByOr) {
  Random random(3);
  CoverageMask left(70, 50);
  CoverageMask right(70, 50);
  verify::CoveredPixels want(70, 50);
  for (int n = 0; n < 12; ++n) {
    const PixelRect rect = rect_of(random, 40);
    (n % 2 == 0 ? left : right).fill(rect);
    want.fill(rect.x0, rect.y0, rect.x1, rect.y1);
  }
  left.merge(0, right.tiles(0, 2));
  left.merge(2, right.tiles(2, right.tile_rows()));
  expect_same(left, want, random);
  EXPECT_THROW(left.merge(6, right.tiles(0, 2)), std::exception);
}

TEST(CoverageMask, RefusesPicturesThatCannotBe) {
  EXPECT_THROW(CoverageMask(0, 5), Error);
  EXPECT_THROW(CoverageMask(5, 0), Error);
  EXPECT_THROW(CoverageMask(5, VisibilityBuffer::kLargest + 1), Error);
}

}  // namespace
}  // namespace footwall::render
