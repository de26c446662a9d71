#include "engine/isosurface/canonical.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/isosurface/plane.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

Surface surface_of(const SampleVolume& volume, float isovalue, bool normals = true) {
  ExtractOptions options;
  options.normals = normals;
  options.keys = true;
  Surface surface;
  extract_plane(volume.field(), isovalue, options, surface);
  return surface;
}

// The same surface with its vertices and triangles in another order, and triangles from other corners.
Surface shuffled(const Surface& from, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> order(from.positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  Surface to;
  to.cells = from.cells;
  to.positions.resize_uninitialised(order.size());
  to.normals.resize_uninitialised(order.size());
  to.keys.resize_uninitialised(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    to.positions[order[n]] = from.positions[n];
    to.normals[order[n]] = from.normals[n];
    to.keys[order[n]] = from.keys[n];
  }
  std::vector<Triangle> triangles;
  for (Triangle t : from.triangles.all()) {
    t = {order[t[0]], order[t[1]], order[t[2]]};
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    triangles.push_back(t);
  }
  std::shuffle(triangles.begin(), triangles.end(), random);
  to.triangles.resize_uninitialised(triangles.size());
  std::copy(triangles.begin(), triangles.end(), to.triangles.data());
  return to;
}

TEST(Canonical, OrderCountsForNothing) {
  const SampleVolume volume = random_volume({7, 8, 9}, 1);
  const Surface surface = surface_of(volume, 0);
  ASSERT_GT(surface.triangles.size(), 100u);
  for (unsigned seed = 1; seed < 4; ++seed) {
    const Surface other = shuffled(surface, seed);
    EXPECT_TRUE(difference(surface, other, volume.size).has_value());
    EXPECT_EQ(difference_but_for_order(surface, other, volume.size), std::nullopt);
  }
  EXPECT_EQ(difference(surface, surface, volume.size), std::nullopt);
}

TEST(Canonical, EveryPartOfASurfaceCounts) {
  const SampleVolume volume = random_volume({5, 6, 7}, 2);
  const Surface surface = surface_of(volume, 0);
  const auto changed = [&](const auto& change) {
    Surface other = shuffled(surface, 5);
    change(other);
    return difference_but_for_order(surface, other, volume.size).value_or("");
  };
  EXPECT_NE(changed([](Surface& s) { s.positions[3].j += 1e-6F; }).find("vertex"), std::string::npos);
  EXPECT_NE(changed([](Surface& s) { s.normals[3].k = -s.normals[3].k; }).find("normal"), std::string::npos);
  // Turned over.
  EXPECT_NE(changed([](Surface& s) { std::swap(s.triangles[4][0], s.triangles[4][1]); }).find("triangle"),
            std::string::npos);
  EXPECT_NE(changed([](Surface& s) { s.triangles.resize_uninitialised(s.triangles.size() - 1); }), "");
  EXPECT_NE(changed([](Surface& s) { s.normals.resize_uninitialised(0); }).find("normals"),
            std::string::npos);
  // A key that belongs elsewhere is told by its place.
  EXPECT_NE(changed([&](Surface& s) {
              s.keys[0] = key_of({4, 5, 6}, 3, volume.size);
            }).find("of ("),
            std::string::npos);
}

TEST(Canonical, NeedsKeysThatDiffer) {
  const SampleVolume volume = random_volume({4, 4, 4}, 3);
  Surface surface = surface_of(volume, 0);
  surface.keys[1] = surface.keys[0];
  EXPECT_THROW(canonical(surface), Error);
  surface.keys.resize_uninitialised(0);
  EXPECT_THROW(canonical(surface), Error);
}

TEST(Canonical, KeysNameTheirPlaces) {
  const survey::Index size{300, 200, 100};
  for (const survey::Index& sample : {survey::Index{0, 0, 0}, {299, 199, 99}, {7, 0, 99}}) {
    for (int axis = 0; axis < 4; ++axis) {
      const KeyPlace place = place_of(key_of(sample, axis, size), size);
      EXPECT_EQ(place.sample, sample);
      EXPECT_EQ(place.axis, axis);
    }
  }
}

}  // namespace
}  // namespace footwall::isosurface
