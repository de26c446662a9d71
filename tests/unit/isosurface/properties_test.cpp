#include "engine/isosurface/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/isosurface/cubes.h"
#include "engine/isosurface/edges.h"
#include "engine/isosurface/plane.h"
#include "engine/isosurface/seed_tables.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

Surface surface_of(const SampleVolume& volume, float isovalue) {
  Surface surface;
  extract_plane(volume.field(), isovalue, {}, surface);
  return surface;
}

TEST(Properties, OfABall) {
  const SampleVolume volume = ball_volume({30, 32, 34}, 11);
  const Surface surface = surface_of(volume, 0);
  const Properties found = properties_of(surface, Measure());
  EXPECT_EQ(found.vertices, surface.positions.size());
  EXPECT_EQ(found.triangles, surface.triangles.size());
  EXPECT_EQ(2 * found.edges, 3 * found.triangles);
  EXPECT_EQ(found.euler, 2);
  EXPECT_EQ(found.genus, 0);
  EXPECT_EQ(found.components.size(), 1u);
  EXPECT_EQ(found.closed_components, 1u);
  EXPECT_EQ(found.boundary_edges.inside + found.boundary_edges.at_border + found.boundary_edges.at_nulls, 0u);
  EXPECT_NEAR(found.area, 4 * M_PI * 121, 0.02 * 4 * M_PI * 121);
  ASSERT_TRUE(found.volume.has_value());
  EXPECT_NEAR(*found.volume, 4 * M_PI / 3 * 1331, 0.02 * 4 * M_PI / 3 * 1331);
}

TEST(Properties, FollowTheSpacings) {
  const SampleVolume volume = ball_volume({30, 32, 34}, 11);
  const Surface surface = surface_of(volume, 0);
  const double plain = *properties_of(surface, Measure()).volume;
  EXPECT_DOUBLE_EQ(*properties_of(surface, Measure::of_spacing(25, 12.5, 4)).volume, plain * 25 * 12.5 * 4);
  EXPECT_DOUBLE_EQ(properties_of(surface, Measure::of_spacing(3, 3, 3)).area,
                   9 * properties_of(surface, Measure()).area);
  // Turned by 30 degrees and left-handed, areas and volumes stay.
  const double c = std::sqrt(0.75), s = 0.5;
  const Measure turned({{{c, s, 0}, {-s, c, 0}, {0, 0, -1}}});
  EXPECT_NEAR(properties_of(surface, turned).area, properties_of(surface, Measure()).area, 1e-9);
  EXPECT_NEAR(*properties_of(surface, turned).volume, plain, 1e-9);
  EXPECT_THROW(Measure::of_spacing(1, 1, 0), Error);
  EXPECT_THROW(Measure::of_spacing(1, INFINITY, 1), Error);
}

TEST(Properties, OfARing) {
  const Properties found = properties_of(surface_of(ring_volume(12, 5), 0), Measure());
  EXPECT_EQ(found.euler, 0);
  EXPECT_EQ(found.genus, 1);
  EXPECT_EQ(found.components.size(), 1u);
  const double exact = 2 * M_PI * M_PI * 12 * 25;
  EXPECT_NEAR(*found.volume, exact, 0.03 * exact);
}

TEST(Properties, AHollowCountsAgainstItsBody) {
  const SampleVolume shell = sampled({31, 31, 31}, [](auto i, auto j, auto k) {
    const double r =
        std::sqrt(static_cast<double>((i - 15) * (i - 15) + (j - 15) * (j - 15) + (k - 15) * (k - 15)));
    return std::min(12 - r, r - 5);
  });
  const Properties found = properties_of(surface_of(shell, 0), Measure());
  EXPECT_EQ(found.components.size(), 2u);
  EXPECT_EQ(found.euler, 4);
  const double exact = 4 * M_PI / 3 * (12. * 12 * 12 - 5. * 5 * 5);
  EXPECT_NEAR(*found.volume, exact, 0.02 * exact);
  EXPECT_LT(Measure().volume_of(found.components[1].volume), 0);
}

TEST(Properties, AnOpenSurfaceEnclosesNothing) {
  const SampleVolume slope =
      sampled({8, 9, 10}, [](auto, auto, auto k) { return static_cast<double>(k) - 4.5; });
  const Properties found = properties_of(surface_of(slope, 0), Measure());
  EXPECT_FALSE(found.volume.has_value());
  EXPECT_EQ(found.closed_components, 0u);
  EXPECT_EQ(found.boundary_edges.at_border, 2u * (7 + 8));
  EXPECT_EQ(found.boundary_edges.inside, 0u);
  EXPECT_EQ(found.euler, 1);
  EXPECT_DOUBLE_EQ(found.area, 7 * 8);
}

TEST(Properties, NullsLeaveACleanBorder) {
  SampleVolume volume = sampled({8, 9, 10}, [](auto, auto, auto k) { return static_cast<double>(k) - 4.5; });
  volume.values[(4 * 9 + 4) * 10 + 5] = kNull;
  const Surface surface = surface_of(volume, 0);
  const Field field = volume.field();
  const BoundaryEdges told = boundary_edges_of(surface, &field);
  EXPECT_EQ(told.at_nulls, 8u);
  EXPECT_EQ(told.at_border, 2u * (7 + 8));
  EXPECT_EQ(told.inside, 0u);
  // Without the samples nobody can tell a null from a crack.
  EXPECT_EQ(boundary_edges_of(surface).inside, 8u);
}

TEST(Properties, RandomVolumesHaveNoCracks) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const SampleVolume volume = random_volume({12, 13, 14}, seed, seed == 1 ? 0.02 : 0);
    const Field field = volume.field();
    const Properties found = properties_of(surface_of(volume, 0), Measure(), &field);
    EXPECT_EQ(found.boundary_edges.inside, 0u);
    EXPECT_EQ(found.non_manifold_edges, 0u);
  }
}

TEST(Properties, TheSeedsRulesAreToldByTheirCracks) {
  const SampleVolume volume = random_volume({12, 13, 14}, 4);
  Surface surface;
  extract_cubes(volume.field(), 0, {}, seed_002_rules(), surface);
  EXPECT_GT(boundary_edges_of(surface).inside, 0u);
  // Those of seed 000 decide faces as the field does, but for rounding: no cracks, other insides.
  Surface by_positions, right;
  extract_plane(volume.field(), 0, {}, seed_000_rules(), by_positions);
  extract_plane(volume.field(), 0, {}, right);
  EXPECT_EQ(boundary_edges_of(by_positions).inside, 0u);
  EXPECT_NE(properties_of(by_positions, Measure()).euler, properties_of(right, Measure()).euler);
}

TEST(Properties, DamageIsSeen) {
  const SampleVolume volume = ball_volume({14, 14, 14}, 4);
  Surface surface = surface_of(volume, 0);
  const Triangle last = surface.triangles[surface.triangles.size() - 1];
  surface.triangles.resize_uninitialised(surface.triangles.size() - 1);
  EXPECT_EQ(boundary_edges_of(surface).inside, 3u);
  EXPECT_FALSE(properties_of(surface, Measure()).volume.has_value());
  surface.triangles[0] = {last[0], last[2], last[1]};
  EXPECT_GT(properties_of(surface, Measure()).non_manifold_edges, 0u);
}

TEST(Properties, SumsDoNotDependOnTheOrder) {
  const SampleVolume volume = random_volume({11, 12, 13}, 5);
  Surface surface = surface_of(volume, 0);
  const Measure measure = Measure::of_spacing(12.5, 25, 3.9);
  const auto sums = [&] {
    ComponentTally all;
    for (const ComponentTally& tally : tallies_of(surface, components_of(surface), measure)) all.merge(tally);
    return all;
  };
  const ComponentTally before = sums();
  std::mt19937 random(1);
  for (int round = 0; round < 3; ++round) {
    const auto all = surface.triangles.all();
    std::shuffle(all.begin(), all.end(), random);
    EXPECT_EQ(sums().area, before.area);
    EXPECT_EQ(sums().volume, before.volume);
  }
}

TEST(Edges, EachComesOnce) {
  const SampleVolume volume = random_volume({6, 7, 8}, 6);
  const Surface surface = surface_of(volume, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> wanted, found;
  for (const Triangle& t : surface.triangles.all()) {
    for (std::size_t n = 0; n < 3; ++n) wanted.push_back(std::minmax(t[n], t[(n + 1) % 3]));
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for_each_edge(surface, [&](const Edge& edge) { found.emplace_back(edge.a, edge.b); });
  EXPECT_EQ(found, wanted);
}

}  // namespace
}  // namespace footwall::isosurface
