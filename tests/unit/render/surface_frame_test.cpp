#include "engine/render/surface_frame.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/verify/coverage_by_definition.h"
#include "rounds.h"
#include "storage/base/error.h"
#include "unit/render/sample_surfaces.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Drawn {
  VisibilityBuffer window{kWidth, kHeight};
  std::vector<Rgba> colours;
};

Drawn draw(std::span<const LitSurface> surfaces, const Camera& camera, int threads) {
  SurfaceFrame frame;
  Drawn drawn;
  frame.project(surfaces, camera, kWidth, kHeight, threads);
  frame.rasterize(drawn.window, threads);
  drawn.colours.resize(drawn.window.pixels().size());
  frame.shade(drawn.window, drawn.colours, threads);
  return drawn;
}

void expect_same(const Drawn& got, const Drawn& want, const std::string& what) {
  EXPECT_TRUE(
      std::equal(got.window.pixels().begin(), got.window.pixels().end(), want.window.pixels().begin()))
      << what;
  EXPECT_EQ(got.colours, want.colours) << what;
}

Camera camera_at(double azimuth, bool perspective) {
  return Camera::look(azimuth, 20, 1, Bounds{{-1, -1, -1}, {1, 1, 1}}, 4.0 / 3, perspective);
}

// Every pixel of a picture of one ball is the one that the definition of coverage says, and the nearest.
TEST(SurfaceFrame, DrawsWhatTheTrianglesOneByOneGive) {
  for (const int around : {6, 40, 700}) {
    const OwnedSurface mesh = sample::ball(around, 5);
    for (const bool perspective : {true, false}) {
      const Camera camera = camera_at(33, perspective);
      const LitSurface surface = mesh.view();
      const Drawn drawn = draw(std::span(&surface, 1), camera, 1);
      VisibilityBuffer one_by_one(kWidth, kHeight);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto clip = [&](std::size_t n) {
          return camera.clip_of(Vec3(mesh.positions[static_cast<std::size_t>(mesh.triangles[t][n])]));
        };
        rasterize_clip(clip(0), clip(1), clip(2), static_cast<PrimitiveId>(5 + t), one_by_one);
      }
      EXPECT_TRUE(
          std::equal(one_by_one.pixels().begin(), one_by_one.pixels().end(), drawn.window.pixels().begin()))
          << around << " around";
    }
  }
}

TEST(SurfaceFrame, ThreadsAndInstructionSetsChangeNoBit) {
  const OwnedSurface mesh = sample::ball(260, 0);
  const LitSurface surface = mesh.view();
  const Camera camera = camera_at(80, true);
  const Drawn want = draw(std::span(&surface, 1), camera, 1);
  EXPECT_GT(std::count_if(want.colours.begin(), want.colours.end(), [](Rgba c) { return c != 0; }), 2000);
  expect_same(draw(std::span(&surface, 1), camera, 4), want, "4 threads");
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    expect_same(draw(std::span(&surface, 1), camera, 1), want, hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
}

// Parts in any order, numbered as in the whole, give the whole's picture; so do parts of parts drawn
// together.
TEST(SurfaceFrame, PartsThatAreNumberedAsTheWholeGiveItsPicture) {
  const OwnedSurface mesh = sample::ball(90, 0);
  const LitSurface whole = mesh.view();
  const Camera camera = camera_at(10, true);
  const Drawn want = draw(std::span(&whole, 1), camera, 1);
  std::vector<OwnedSurface> parts;
  for (std::size_t n = 0; n < 5; ++n) parts.push_back(sample::every(mesh, 5, n, 37));
  std::vector<LitSurface> surfaces;
  for (const std::size_t n : {3U, 0U, 4U, 1U, 2U}) surfaces.push_back(parts[n].view());
  expect_same(draw(surfaces, camera, 1), want, "parts");
}

TEST(SurfaceFrame, LightsTheSideThatIsSeen) {
  const Camera camera = Camera::look(0, 0, 1, Bounds{{-1, -1, -1}, {1, 1, 1}}, 4.0 / 3, false);
  // Facing the eye, which looks north.
  OwnedSurface mesh;
  mesh.colour = sample::kColour;
  mesh.positions = {{-0.8F, 0, -0.8F}, {0.8F, 0, -0.8F}, {0, 0, 0.8F}};
  mesh.normals.assign(3, {0, -1, 0});
  mesh.triangles = {{0, 1, 2}};
  mesh.runs = {{0, 0}};
  const auto middle = [&](const OwnedSurface& what) {
    const LitSurface surface = what.view();
    const Drawn drawn = draw(std::span(&surface, 1), camera, 1);
    return drawn.colours[kWidth * (kHeight / 2) + kWidth / 2];
  };
  const Rgba front = middle(mesh);
  OwnedSurface behind = mesh;
  std::swap(behind.triangles[0][1], behind.triangles[0][2]);
  behind.normals.assign(3, {0, 1, 0});
  const Rgba back = middle(behind);
  EXPECT_LT(red(back), red(front));
  EXPECT_GT(red(back), red(front) / 2);

  // A mirroring map turns winding and normals; what is drawn is the same.
  OwnedSurface mirrored = mesh;
  mirrored.placement.linear = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::swap(mirrored.positions[0], mirrored.positions[1]);
  for (Vec3f& p : mirrored.positions) p.x = -p.x;
  std::swap(mirrored.triangles[0][1], mirrored.triangles[0][2]);
  std::swap(mirrored.triangles[0][0], mirrored.triangles[0][1]);
  EXPECT_EQ(middle(mirrored), front);

  // Turned away from the light it is darker; in between, between (Gouraud).
  OwnedSurface slanted = mesh;
  slanted.normals[2] = {0, 0, -1};
  EXPECT_LT(red(middle(slanted)), red(front));
  // A stretched frame: normals go by the inverse transpose and stay the surface's.
  OwnedSurface stretched = mesh;
  stretched.placement.linear = {1, 0, 0, 0, 50, 0, 0, 0, 1};
  EXPECT_EQ(middle(stretched), front);
}

// Interpolated between the corners even where one of them is behind the eye.
TEST(SurfaceFrame, ClippedTrianglesAreShadedAsTheRest) {
  const OwnedSurface plane = sample::floor(1, 0);
  Camera camera = Camera::look_at({0, 0, 0.3}, {0, 5, 0}, {0, 0, 1},
                                  std::array<Vec3, 2>{Vec3{-50, -50, 0}, Vec3{50, 50, 0}}, 4.0 / 3, true);
  const LitSurface coarse = plane.view();
  const Drawn large = draw(std::span(&coarse, 1), camera, 1);
  const OwnedSurface fine = sample::floor(64, 0);
  const LitSurface many = fine.view();
  const Drawn small = draw(std::span(&many, 1), camera, 1);
  int compared = 0;
  for (std::size_t n = 0; n < large.colours.size(); ++n) {
    if (large.colours[n] == 0 || small.colours[n] == 0) continue;
    ++compared;
    ASSERT_NEAR(red(large.colours[n]), red(small.colours[n]), 2) << "pixel " << n;
    ASSERT_NEAR(depth_of(large.window.pixels()[n]), depth_of(small.window.pixels()[n]), 1e-4);
  }
  EXPECT_GT(compared, kWidth * kHeight / 4);
}

// Whether the pixel's centre, moved a little as the definition of coverage says, lies inside a closed line:
// it crosses an odd number of edges on its way to the right.
bool is_inside_rim(std::span<const ScreenVertex> rim, int x, int y) {
  bool inside = false;
  const std::int64_t centre = std::int64_t{y} * kSubPixels + kSubPixels / 2;
  for (std::size_t n = 0; n < rim.size(); ++n) {
    const ScreenVertex& a = rim[n];
    const ScreenVertex& b = rim[(n + 1) % rim.size()];
    if ((a.y <= centre) == (b.y <= centre)) continue;
    const int side = verify::side_of_edge({a.x, a.y}, {b.x, b.y}, x, y, kSubPixels);
    inside = inside != (side == (a.y <= centre ? 1 : -1));
  }
  return inside;
}

// Closed fans of triangles, as meshes: each pixel's centre inside is hit exactly once, and by the triangle
// that the definition of coverage names.
TEST(SurfaceFrame, HitsEachPixelOfAClosedFanExactlyOnce) {
  std::mt19937 random(11);
  const auto between = [&](std::int32_t lo, std::int32_t hi) {
    return std::uniform_int_distribution<std::int32_t>(lo, hi)(random);
  };
  constexpr int kSide = 24;
  std::int64_t triangles = 0;
  VisibilityBuffer window(kSide, kSide);
  const std::int64_t wanted = rounds(100'000);
  while (triangles < wanted) {
    const int blades = between(3, 14);
    const double reach = 1 + 0.01 * between(0, 900);
    std::vector<ScreenVertex> vertices{
        {between(4 * kSubPixels, 20 * kSubPixels), between(4 * kSubPixels, 20 * kSubPixels), 0.5F, 0}};
    if (between(0, 2) == 0) vertices[0].x = vertices[0].x / 128 * 128;
    for (int n = 0; n < blades; ++n) {
      const double angle = 2 * 3.14159265358979 * (n + 0.003 * between(0, 100)) / blades;
      vertices.push_back(
          {vertices[0].x + static_cast<std::int32_t>(std::lround(reach * kSubPixels * std::cos(angle))),
           vertices[0].y + static_cast<std::int32_t>(std::lround(reach * kSubPixels * std::sin(angle))), 0.5F,
           0});
    }
    std::vector<TriangleIndices> fan;
    for (int n = 0; n < blades; ++n) {
      const std::int32_t next = 1 + (n + 1) % blades;
      if (n % 2 == 0)
        fan.push_back({0, 1 + n, next});
      else
        fan.push_back({next, 1 + n, 0});
    }
    window.clear();
    rasterize({}, {}, vertices, fan, 0, window);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        int hits = 0;
        PrimitiveId by = kNoPrimitive;
        for (std::size_t t = 0; t < fan.size(); ++t) {
          const auto at = [&](std::size_t n) {
            const ScreenVertex& v = vertices[static_cast<std::size_t>(fan[t][n])];
            return verify::RasterPoint{v.x, v.y};
          };
          if (!verify::covers(at(0), at(1), at(2), x, y, kSubPixels)) continue;
          ++hits;
          by = static_cast<PrimitiveId>(t);
        }
        ASSERT_EQ(hits, is_inside_rim(std::span(vertices).subspan(1), x, y) ? 1 : 0)
            << "pixel " << x << "," << y;
        ASSERT_EQ(primitive_of(window.at(x, y)), by) << "pixel " << x << "," << y;
      }
    }
    triangles += blades;
  }
}

TEST(SurfaceFrame, RefusesWhatIsNotSound) {
  OwnedSurface mesh = sample::ball(8, 0);
  check(mesh.view());
  const auto refused = [](const OwnedSurface& what) { EXPECT_THROW(check(what.view()), Error); };
  OwnedSurface broken = mesh;
  broken.normals.pop_back();
  refused(broken);
  broken = mesh;
  broken.triangles[3][1] = 100000;
  refused(broken);
  broken = mesh;
  broken.runs = {{0, 10}, {4, 12}};
  refused(broken);
  broken = mesh;
  broken.placement.linear[0] = 0;
  refused(broken);
}

}  // namespace
}  // namespace footwall::render
