#include "engine/isosurface/cap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/isosurface/plane.h"
#include "engine/isosurface/properties.h"
#include "engine/verify/surface_by_definition.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

Surface capped(const Field& field, float isovalue) {
  ExtractOptions options;
  options.keys = true;
  Surface surface;
  extract_plane(field, isovalue, options, surface);
  cap(field, isovalue, surface);
  return surface;
}

// The slow way: each cell is a volume of its own, capped on all sides.
double volume_by_cells(const SampleVolume& volume, float isovalue) {
  double sum = 0;
  for (std::int64_t i = 0; i + 1 < volume.size[0]; ++i) {
    for (std::int64_t j = 0; j + 1 < volume.size[1]; ++j) {
      for (std::int64_t k = 0; k + 1 < volume.size[2]; ++k) {
        SamplePart cell = part_of(volume, {{i, j, k}, {i + 2, j + 2, k + 2}});
        cell.field.origin = {0, 0, 0};
        cell.field.volume_size = {2, 2, 2};
        const Properties found = properties_of(capped(cell.field, isovalue), Measure());
        EXPECT_TRUE(found.volume.has_value());
        sum += found.volume.value_or(0);
      }
    }
  }
  return sum;
}

TEST(Cap, ClosesEverySurface) {
  for (const survey::Index& size : {survey::Index{2, 2, 2}, {2, 3, 9}, {5, 6, 7}, {9, 2, 4}}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const SampleVolume volume = random_volume(size, seed);
      const Surface surface = capped(volume.field(), 0.1F);
      const Properties found = properties_of(surface, Measure());
      EXPECT_EQ(verify::unsoundness(surface), "");
      EXPECT_EQ(found.non_manifold_edges, 0u);
      EXPECT_EQ(found.boundary_edges.inside + found.boundary_edges.at_border, 0u);
      EXPECT_EQ(found.euler % 2, 0);
      ASSERT_TRUE(found.volume.has_value());
      EXPECT_GE(*found.volume, 0);
      EXPECT_LE(*found.volume,
                static_cast<double>((size[0] - 1) * (size[1] - 1) * (size[2] - 1)) * (1 + 1e-9));
    }
  }
}

TEST(Cap, EnclosesWhatTheCellsEnclose) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SampleVolume volume = random_volume({5, 6, 7}, seed);
    EXPECT_NEAR(*properties_of(capped(volume.field(), 0.1F), Measure()).volume, volume_by_cells(volume, 0.1F),
                1e-5);
  }
}

TEST(Cap, OfASlopeIsTheHalfSpace) {
  // i + 0.5 >= 3.25 of 0..7: a box.
  const SampleVolume slope =
      sampled({8, 5, 6}, [](auto i, auto, auto) { return static_cast<double>(i) + 0.5; });
  const Properties found = properties_of(capped(slope.field(), 3.25F), Measure());
  EXPECT_NEAR(*found.volume, (7 - 2.75) * 4 * 5, 1e-5);
  EXPECT_NEAR(found.area, 2 * (4.25 * 4 + 4.25 * 5 + 4 * 5), 1e-5);
  EXPECT_EQ(found.euler, 2);
}

TEST(Cap, OfAFullVolumeIsItsBox) {
  const SampleVolume full = sampled({4, 5, 6}, [](auto...) { return 1.0; });
  const Surface box = capped(full.field(), 0.5F);
  const Properties found = properties_of(box, Measure());
  EXPECT_DOUBLE_EQ(*found.volume, 3 * 4 * 5);
  EXPECT_DOUBLE_EQ(found.area, 2 * (3 * 4 + 3 * 5 + 4 * 5));
  EXPECT_EQ(found.euler, 2);
  // Nothing at or above: nothing to close.
  EXPECT_TRUE(capped(full.field(), 1.5F).triangles.empty());
  const SampleVolume flat = sampled({1, 5, 6}, [](auto...) { return 1.0; });
  EXPECT_TRUE(capped(flat.field(), 0.5F).triangles.empty());
}

TEST(Cap, StaysOpenAtNulls) {
  SampleVolume volume = sampled({8, 9, 10}, [](auto, auto, auto k) { return static_cast<double>(k) - 4.5; });
  volume.values[(0 * 9 + 4) * 10 + 5] = kNull;
  const Field field = volume.field();
  const Surface surface = capped(field, 0);
  const Properties found = properties_of(surface, Measure(), &field);
  EXPECT_FALSE(found.volume.has_value());
  EXPECT_GT(found.boundary_edges.at_nulls + found.boundary_edges.at_border, 0u);
  EXPECT_EQ(found.boundary_edges.inside, 0u);
  EXPECT_EQ(found.non_manifold_edges, 0u);
}

TEST(Cap, TakesOnlyTheFieldsOwnSurface) {
  const SampleVolume volume = random_volume({5, 5, 5}, 1), other = random_volume({5, 5, 5}, 2);
  ExtractOptions options;
  Surface surface;
  extract_plane(volume.field(), 0, options, surface);
  EXPECT_THROW(cap(volume.field(), 0, surface), Error);  // no keys
  options.keys = true;
  extract_plane(volume.field(), 0, options, surface);
  EXPECT_THROW(cap(other.field(), 0, surface), Error);
}

}  // namespace
}  // namespace footwall::isosurface
