#include "engine/render/rasterizer.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/verify/coverage_by_definition.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

using Random = std::mt19937;

std::int32_t between(Random& random, std::int32_t lo, std::int32_t hi) {
  return std::uniform_int_distribution<std::int32_t>(lo, hi)(random);
}

bool covers(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, int x, int y) {
  return verify::covers({a.x, a.y}, {b.x, b.y}, {c.x, c.y}, x, y, kSubPixels);
}

// Positions that are often exactly on pixel centres and borders, where the fill rule decides.
ScreenVertex vertex(Random& random, std::int32_t lo_pixel, std::int32_t hi_pixel) {
  const std::int32_t grain = between(random, 0, 1) == 0 ? 1 : kSubPixels / 2;
  ScreenVertex v;
  v.x = between(random, lo_pixel * kSubPixels / grain, hi_pixel * kSubPixels / grain) * grain;
  v.y = between(random, lo_pixel * kSubPixels / grain, hi_pixel * kSubPixels / grain) * grain;
  v.depth = static_cast<float>(between(random, 0, 1000)) / 1000.0F;
  return v;
}

void expect_reference_coverage(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                               VisibilityBuffer& buffer) {
  buffer.clear();
  rasterize_screen(a, b, c, 7, buffer);
  for (int y = 0; y < buffer.height(); ++y) {
    for (int x = 0; x < buffer.width(); ++x) {
      const bool drawn = primitive_of(buffer.at(x, y)) == 7;
      ASSERT_EQ(drawn, covers(a, b, c, x, y))
          << "pixel " << x << "," << y << " of (" << a.x << "," << a.y << ") (" << b.x << "," << b.y << ") ("
          << c.x << "," << c.y << ")";
      if (!drawn) continue;
      const float depth = depth_of(buffer.at(x, y));
      ASSERT_GE(depth, std::min({a.depth, b.depth, c.depth}) - 1e-6F);
      ASSERT_LE(depth, std::max({a.depth, b.depth, c.depth}) + 1e-6F);
    }
  }
}

TEST(Rasterizer, CoversWhatTheDefinitionSays) {
  Random random(1);
  VisibilityBuffer buffer(40, 31);
  for (int n = 0; n < 12000; ++n) {
    expect_reference_coverage(vertex(random, -6, 46), vertex(random, -6, 46), vertex(random, -6, 46), buffer);
    if (HasFatalFailure()) return;
  }
}

TEST(Rasterizer, CoversWhatTheDefinitionSaysForSmallThinAndHugeTriangles) {
  Random random(2);
  VisibilityBuffer buffer(33, 24);
  for (int n = 0; n < 3000; ++n) {
    const ScreenVertex a = vertex(random, 0, 24);
    ScreenVertex near = a;
    near.x += between(random, -600, 600);
    near.y += between(random, -600, 600);
    ScreenVertex nearer = a;
    nearer.x += between(random, -3, 3);
    nearer.y += between(random, -3, 3);
    expect_reference_coverage(a, near, nearer, buffer);
    expect_reference_coverage(a, vertex(random, 0, 24), nearer, buffer);
    expect_reference_coverage(a, vertex(random, -kGuardBand, kGuardBand / 2),
                              vertex(random, -kGuardBand / 2, kGuardBand / 2), buffer);
    expect_reference_coverage(vertex(random, -kGuardBand, 0), vertex(random, -kGuardBand / 2, kGuardBand / 2),
                              vertex(random, 0, kGuardBand / 2), buffer);
    expect_reference_coverage(a, a, near, buffer);
    if (HasFatalFailure()) return;
  }
}

TEST(Rasterizer, HitsEachPixelOfAFanExactlyOnce) {
  Random random(3);
  VisibilityBuffer buffer(48, 48);
  for (int n = 0; n < 300; ++n) {
    const ScreenVertex hub = vertex(random, 10, 38);
    const int blades = between(random, 3, 12);
    std::vector<ScreenVertex> rim;
    for (int blade = 0; blade < blades; ++blade) {
      // Far outside of the picture all around, so that the fan covers every pixel.
      const double angle = 2 * 3.14159265358979 * (blade + 0.3 * between(random, 0, 100) / 100.0) / blades;
      rim.push_back({static_cast<std::int32_t>(std::lround((24 + 400 * std::cos(angle)) * kSubPixels)),
                     static_cast<std::int32_t>(std::lround((24 + 400 * std::sin(angle)) * kSubPixels)), 0.5F,
                     0});
    }
    std::vector<int> hits(48 * 48);
    for (std::size_t blade = 0; blade < rim.size(); ++blade) {
      buffer.clear();
      const ScreenVertex& next = rim[(blade + 1) % rim.size()];
      // Either orientation of the triangles has to do.
      if (blade % 2 == 0)
        rasterize_screen(hub, rim[blade], next, 1, buffer);
      else
        rasterize_screen(next, rim[blade], hub, 1, buffer);
      for (std::size_t p = 0; p < hits.size(); ++p) hits[p] += primitive_of(buffer.pixels()[p]) == 1 ? 1 : 0;
    }
    for (std::size_t p = 0; p < hits.size(); ++p) ASSERT_EQ(hits[p], 1) << "pixel " << p << " of fan " << n;
  }
}

TEST(Rasterizer, ShowsTheNearestWhateverTheOrder) {
  Random random(4);
  std::vector<std::array<ScreenVertex, 3>> triangles;
  for (int n = 0; n < 60; ++n)
    triangles.push_back({vertex(random, -5, 50), vertex(random, -5, 50), vertex(random, -5, 50)});
  VisibilityBuffer forwards(45, 45);
  VisibilityBuffer backwards(45, 45);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const std::size_t last = triangles.size() - 1 - n;
    rasterize_screen(triangles[n][0], triangles[n][1], triangles[n][2], static_cast<PrimitiveId>(n),
                     forwards);
    rasterize_screen(triangles[last][0], triangles[last][1], triangles[last][2],
                     static_cast<PrimitiveId>(last), backwards);
  }
  EXPECT_TRUE(std::equal(forwards.pixels().begin(), forwards.pixels().end(), backwards.pixels().begin()));

  // A far triangle does not cover a near one; between them depth is that of the plane.
  VisibilityBuffer buffer(10, 10);
  const auto corner = [](std::int32_t x, std::int32_t y, float depth) {
    return ScreenVertex{x * kSubPixels, y * kSubPixels, depth, 0};
  };
  rasterize_screen(corner(0, 0, 0.2F), corner(10, 0, 0.4F), corner(0, 10, 0.2F), 1, buffer);
  rasterize_screen(corner(0, 0, 0.6F), corner(10, 0, 0.6F), corner(0, 10, 0.6F), 0, buffer);
  EXPECT_EQ(primitive_of(buffer.at(2, 2)), 1U);
  EXPECT_NEAR(depth_of(buffer.at(4, 2)), 0.2 + 0.2 * 0.45, 1e-6);
}

TEST(Rasterizer, DrawsTheSameThroughAnyWindowAndMergesToTheWhole) {
  Random random(5);
  std::vector<std::array<ScreenVertex, 3>> triangles;
  for (int n = 0; n < 200; ++n) {
    const std::int32_t reach = n % 3 == 0 ? 400 : 70;
    triangles.push_back(
        {vertex(random, -5, 60), vertex(random, -reach, reach), vertex(random, -reach, reach)});
  }
  const auto draw = [&](VisibilityBuffer& into, std::size_t part, std::size_t parts) {
    for (std::size_t n = part; n < triangles.size(); n += parts) {
      rasterize_screen(triangles[n][0], triangles[n][1], triangles[n][2], static_cast<PrimitiveId>(n), into);
    }
  };
  VisibilityBuffer whole(50, 60);
  draw(whole, 0, 1);
  VisibilityBuffer merged(50, 60);
  for (const std::size_t part : {2U, 0U, 1U}) {
    VisibilityBuffer own(50, 60);
    draw(own, part, 3);
    merged.merge(own);
  }
  EXPECT_TRUE(std::equal(whole.pixels().begin(), whole.pixels().end(), merged.pixels().begin()));
  for (int first = 0; first < 60; first += 17) {
    VisibilityBuffer window(50, 60, first, std::min(17, 60 - first));
    draw(window, 0, 1);
    EXPECT_TRUE(std::equal(window.pixels().begin(), window.pixels().end(), whole.row(first).begin()))
        << "from row " << first;
  }
  EXPECT_THROW(merged.merge(VisibilityBuffer(50, 60, 0, 10)), Error);
  EXPECT_THROW(VisibilityBuffer(0, 10), Error);
  EXPECT_THROW(VisibilityBuffer(10, 10, 5, 6), Error);
}

TEST(Rasterizer, DrawsTheSameBitsOnEveryInstructionSet) {
  Random random(7);
  std::vector<std::array<ScreenVertex, 3>> triangles;
  for (int n = 0; n < 4000; ++n) {
    const std::int32_t reach = n % 50 == 0 ? 300 : 12;
    const ScreenVertex a = vertex(random, 0, 90);
    ScreenVertex b = vertex(random, -reach, reach);
    ScreenVertex c = vertex(random, -reach, reach);
    b.x += a.x;
    b.y += a.y;
    c.x += a.x;
    c.y += a.y;
    triangles.push_back({a, b, c});
  }
  std::vector<VisibilityBuffer> pictures;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    pictures.emplace_back(90, 90);
    for (std::size_t n = 0; n < triangles.size(); ++n) {
      rasterize_screen(triangles[n][0], triangles[n][1], triangles[n][2], static_cast<PrimitiveId>(n),
                       pictures.back());
    }
    EXPECT_TRUE(std::equal(pictures.back().pixels().begin(), pictures.back().pixels().end(),
                           pictures.front().pixels().begin()))
        << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_GE(pictures.size(), 1U);
}

// Whether the triangle in clip space is seen at a place of the picture: 1 yes, 0 no, -1 too close to a border
// to say.
int seen_at(const std::array<Vec4, 3>& t, double x, double y) {
  double weights[3];
  double sum = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec4& b = t[(n + 1) % 3];
    const Vec4& c = t[(n + 2) % 3];
    weights[n] = x * (b.y * c.w - c.y * b.w) - y * (b.x * c.w - c.x * b.w) + (b.x * c.y - c.x * b.y);
    sum += std::abs(weights[n]);
  }
  double w = 0;
  double z = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    weights[n] /= sum;
    w += weights[n] * t[n].w;
    z += weights[n] * t[n].z;
  }
  const double sign = w > 0 ? 1 : -1;
  bool inside = true;
  for (double& weight : weights) {
    if (std::abs(weight) < 0.01) return -1;
    inside = inside && weight * sign > 0;
  }
  if (!inside) return 0;
  if (std::abs(std::abs(z / w) - 1) < 0.05 || std::abs(w) < 0.01) return -1;
  return std::abs(z / w) < 1 ? 1 : 0;
}

TEST(Rasterizer, ClipsWhatReachesBehindTheEye) {
  Random random(6);
  std::uniform_real_distribution<double> wide(-4, 4);
  int seen = 0;
  int crossing = 0;
  for (int n = 0; n < 2000; ++n) {
    std::array<Vec4, 3> t;
    for (Vec4& p : t) {
      p = {wide(random), wide(random), 0, wide(random)};
      p.z = 1.5 * p.w - 1;  // as a perspective camera has it: in front of the near plane, w > 0
    }
    if (n % 4 == 0) t[0].x *= 1e9;  // far beyond the guard band
    crossing += (t[0].w > 0) != (t[1].w > 0) ? 1 : 0;
    VisibilityBuffer buffer(24, 24);
    rasterize_clip(t[0], t[1], t[2], 3, buffer);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        const int expected = seen_at(t, (x + 0.5) / 12 - 1, 1 - (y + 0.5) / 12);
        if (expected < 0) continue;
        ASSERT_EQ(primitive_of(buffer.at(x, y)) == 3, expected == 1)
            << "pixel " << x << "," << y << " of triangle " << n;
        seen += expected;
      }
    }
  }
  EXPECT_GT(seen, 10000);
  EXPECT_GT(crossing, 500);
}

TEST(Rasterizer, SkipsWhatIsNotFiniteAndRefusesBadIndices) {
  const Matrix4 identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const std::vector<Vec3f> positions{{-1, -1, 0}, {1, -1, 0},       {0, 1, 0},
                                     {NAN, 0, 0}, {INFINITY, 0, 0}, {1e30F, 0, 0}};
  std::vector<ScreenVertex> vertices(positions.size());
  project(identity, positions, 16, 16, vertices);
  const std::vector<TriangleIndices> triangles{{0, 1, 3}, {4, 1, 2}, {0, 1, 2}, {0, 5, 2}};
  check_indices(triangles, positions.size());
  VisibilityBuffer buffer(16, 16);
  rasterize(identity, positions, vertices, std::span(triangles).first(2), 0, buffer);
  EXPECT_TRUE(std::all_of(buffer.pixels().begin(), buffer.pixels().end(),
                          [](Visible v) { return v == kBackground; }));
  rasterize(identity, positions, vertices, triangles, 0, buffer);
  EXPECT_EQ(primitive_of(buffer.at(8, 8)), 2U);
  EXPECT_NE(primitive_of(buffer.at(14, 8)), 2U);
  EXPECT_EQ(primitive_of(buffer.at(14, 8)), 3U) << "the far corner is cut off, not the triangle";
  EXPECT_THROW(check_indices(triangles, 5), Error);
  EXPECT_THROW(check_indices(std::vector<TriangleIndices>{{0, -1, 1}}, 5), Error);
}

}  // namespace
}  // namespace footwall::render
