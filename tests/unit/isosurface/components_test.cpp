#include "engine/isosurface/components.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/isosurface/canonical.h"
#include "engine/isosurface/plane.h"
#include "engine/verify/surface_by_definition.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

// Balls of these radii, one after the other along k.
SampleVolume balls(const std::vector<double>& radii) {
  return sampled({21, 21, 20 * static_cast<std::int64_t>(radii.size())}, [&](auto i, auto j, auto k) {
    const std::int64_t which = k / 20;
    return ball(static_cast<double>(i) - 10, static_cast<double>(j) - 10,
                static_cast<double>(k - 20 * which) - 10, radii[static_cast<std::size_t>(which)]);
  });
}

Surface surface_of(const SampleVolume& volume, float isovalue) {
  ExtractOptions options;
  options.keys = true;
  Surface surface;
  extract_plane(volume.field(), isovalue, options, surface);
  return surface;
}

struct Counted {
  explicit Counted(const Surface& surface)
      : components(components_of(surface)), tallies(tallies_of(surface, components, Measure())) {}
  Components components;
  std::vector<ComponentTally> tallies;
};

TEST(Components, EachIsCountedByItself) {
  const std::vector<double> radii{6.2, 3.3, 8.1};
  const Surface surface = surface_of(balls(radii), 0);
  const Counted counted(surface);
  ASSERT_EQ(counted.components.count, 3u);
  std::uint64_t triangles = 0;
  for (const ComponentTally& tally : counted.tallies) {
    triangles += tally.triangles;
    EXPECT_TRUE(tally.closed());
    EXPECT_EQ(tally.euler(), 2);
    EXPECT_EQ(tally.genus(), 0);
    const double radius = radii[static_cast<std::size_t>(tally.lo.k / 20)];
    EXPECT_NEAR(tally.hi.i - tally.lo.i, 2 * radius, 0.2);
    EXPECT_NEAR(tally.hi.k - tally.lo.k, 2 * radius, 0.2);
    EXPECT_NEAR(Measure().area_of(tally.area), 4 * M_PI * radius * radius, 0.03 * 4 * M_PI * radius * radius);
  }
  EXPECT_EQ(triangles, surface.triangles.size());
  // Numbered by their first vertex: the largest ball reaches the smallest i.
  EXPECT_GT(counted.tallies[0].triangles, counted.tallies[1].triangles);
  EXPECT_LT(counted.tallies[0].first, counted.tallies[1].first);
}

TEST(Components, TheLargestAreKeptWhole) {
  const Surface surface = surface_of(balls({6.2, 3.3, 8.1}), 0);
  const Counted counted(surface);
  const auto with = [&](const ComponentFilter& filter) {
    return keep(surface, counted.components, kept(counted.tallies, Measure(), filter));
  };
  EXPECT_EQ(difference(with({}), surface, {21, 21, 60}), std::nullopt);
  EXPECT_EQ(with({}).row_first, surface.row_first);
  // What is left is the surface of a volume without the other balls.
  const Surface one = with({1, 0});
  const Surface alone = surface_of(balls({-100, -100, 8.1}), 0);
  EXPECT_EQ(one.triangles.size(), alone.triangles.size());
  EXPECT_EQ(one.row_first, alone.row_first);
  EXPECT_EQ(verify::unsoundness(one), "");
  EXPECT_EQ(components_of(one).count, 1u);
  EXPECT_EQ(components_of(with({2, 0})).count, 2u);
  EXPECT_EQ(components_of(with({0, 300})).count, 2u);
  EXPECT_EQ(components_of(with({9, 700})).count, 1u);
  EXPECT_TRUE(with({0, 1e9}).triangles.empty());
  EXPECT_EQ(with({0, 1e9}).row_first, std::vector<std::uint64_t>(surface.row_first.size(), 0));
}

TEST(Components, OfEqualOnesTheFirstIsKept) {
  SampleVolume volume = balls({5, 5, 5});
  // Halfway between samples, so that rounding is the same for all.
  for (float& value : volume.values) value = value >= 0 ? 1.0F : -1.0F;
  const Counted counted(surface_of(volume, 0));
  ASSERT_EQ(counted.tallies[0].area, counted.tallies[2].area);
  EXPECT_EQ(kept(counted.tallies, Measure(), {2, 0}), (std::vector<std::uint8_t>{1, 1, 0}));
}

TEST(Components, TalliesOfPartsAddUp) {
  const Counted counted(surface_of(balls({6.2, 3.3}), 0));
  ComponentTally both = counted.tallies[1], other = counted.tallies[0];
  both.merge(counted.tallies[0]);
  other.merge(counted.tallies[1]);
  EXPECT_EQ(both.first, counted.tallies[0].first);
  EXPECT_EQ(both.area, other.area);
  EXPECT_EQ(both.lo, other.lo);
  EXPECT_EQ(both.hi, other.hi);
  EXPECT_EQ(both.euler(), 4);
  ComponentTally nothing;
  nothing.merge(counted.tallies[1]);
  EXPECT_EQ(nothing.lo, counted.tallies[1].lo);
  EXPECT_EQ(nothing.first, counted.tallies[1].first);
  nothing.merge(ComponentTally());
  EXPECT_EQ(nothing.first, counted.tallies[1].first);
}

TEST(Components, NoAreaIsBelowNothing) {
  const Counted counted(surface_of(balls({5}), 0));
  EXPECT_THROW(kept(counted.tallies, Measure(), {0, -1}), Error);
  EXPECT_THROW(kept(counted.tallies, Measure(), {0, kNull}), Error);
}

TEST(Components, OfNothingThereAreNone) {
  const Surface surface = surface_of(balls({-5}), 0);
  const Counted counted(surface);
  EXPECT_EQ(counted.components.count, 0u);
  EXPECT_TRUE(keep(surface, counted.components, {}).positions.empty());
}

}  // namespace
}  // namespace footwall::isosurface
