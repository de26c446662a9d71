#include "engine/isosurface/visible/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

struct Volume {
  survey::Index size;
  std::vector<float> values;
  Field field() const { return {values, size, {0, 0, 0}, size}; }
};

// Smooth enough to leave many leaves without the isovalue 0.
Volume wavy(const survey::Index& size) {
  Volume volume{size, {}};
  for (std::int64_t i = 0; i < size[0]; ++i) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t k = 0; k < size[2]; ++k) {
        const auto at = [](std::int64_t n) { return 0.11F * static_cast<float>(n); };
        const float v = std::sin(at(i)) + std::cos(at(j)) + std::sin(at(k) + 1) - 1.2F;
        volume.values.push_back((i + 3 * j + 7 * k) % 211 == 0 ? NAN : v);
      }
    }
  }
  return volume;
}

TEST(Octree, LeavesOfEightCellsAreTheBricks) {
  for (const survey::Index& size : {survey::Index{1, 1, 1}, {9, 33, 40}, {18, 1, 7}}) {
    const Volume volume = wavy(size);
    const BrickRanges bricks = brick_ranges(volume.field(), 1);
    const BrickRanges leaves = leaf_ranges(volume.field(), kBrickCells, 2);
    EXPECT_EQ(leaves.dims, bricks.dims);
    EXPECT_EQ(leaves.min, bricks.min);
    EXPECT_EQ(leaves.max, bricks.max);
    EXPECT_EQ(leaves.has_null, bricks.has_null);
  }
}

// By looking at every sample of every node.
TEST(Octree, NodesAreActiveWhereTheirSamplesLieOnBothSides) {
  const survey::Index size{21, 40, 33};
  const Volume volume = wavy(size);
  for (const survey::Index& leaf : {survey::Index{8, 8, 8}, {3, 5, 2}, {1, 1, 1}, {64, 64, 64}}) {
    const Octree tree(leaf_ranges(volume.field(), leaf, 1).tables(), size, leaf);
    for (int level = 0; level < tree.levels(); ++level) {
      const survey::Index dims = tree.dims(level);
      for (std::int64_t a = 0; a < dims[0]; ++a) {
        for (std::int64_t b = 0; b < dims[1]; ++b) {
          for (std::int64_t c = 0; c < dims[2]; ++c) {
            const survey::Box cells = tree.cells_of({level, {a, b, c}});
            bool below = false;
            bool above = false;
            for (std::int64_t i = cells.lo[0]; i <= cells.hi[0]; ++i) {
              for (std::int64_t j = cells.lo[1]; j <= cells.hi[1]; ++j) {
                for (std::int64_t k = cells.lo[2]; k <= cells.hi[2]; ++k) {
                  const float v = volume.values[static_cast<std::size_t>((i * size[1] + j) * size[2] + k)];
                  below = below || v < 0;
                  above = above || v >= 0;
                }
              }
            }
            ASSERT_EQ(tree.is_active({level, {a, b, c}}, 0), below && above) << level << " " << a << " " << b;
          }
        }
      }
    }
    EXPECT_EQ(tree.dims(tree.levels() - 1), (survey::Index{1, 1, 1}));
  }
}

// Box n hides nothing of an earlier box m if some axis-parallel plane has m on the eye's side, or m does not
// lie before n as seen along any line: here by lines of sight through random points of the volume.
TEST(Octree, NoLineOfSightMeetsALaterLeafFirst) {
  const survey::Index size{70, 50, 61};
  const Volume volume = wavy(size);
  const survey::Index leaf{8, 4, 8};
  const Octree tree(leaf_ranges(volume.field(), leaf, 1).tables(), size, leaf);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 2);
  for (int view = 0; view < 40; ++view) {
    const auto anywhere = [&] {
      return survey::Vector3{share(random) * 70, share(random) * 50, share(random) * 61};
    };
    const bool perspective = view % 2 == 0;
    const survey::Vector3 place = perspective ? anywhere() : anywhere() - survey::Vector3{35, 25, 30};
    const std::vector<survey::Index> order = tree.active({place, perspective}, 0);
    std::vector<int> rank(static_cast<std::size_t>(tree.dims(0)[0] * tree.dims(0)[1] * tree.dims(0)[2]), -1);
    const auto slot = [&](const survey::Index& at) {
      return static_cast<std::size_t>((at[0] * tree.dims(0)[1] + at[1]) * tree.dims(0)[2] + at[2]);
    };
    for (std::size_t n = 0; n < order.size(); ++n) {
      ASSERT_EQ(rank[slot(order[n])], -1) << "twice";
      rank[slot(order[n])] = static_cast<int>(n);
    }
    const auto all = std::count_if(rank.begin(), rank.end(), [](int n) { return n >= 0; });
    EXPECT_EQ(static_cast<std::size_t>(all), order.size());
    for (int line = 0; line < 50; ++line) {
      const survey::Vector3 target = anywhere();
      const survey::Vector3 start = perspective ? place : target - place * 8;
      const survey::Vector3 end = perspective ? start + (target - start) * 5 : target + place * 8;
      int last = -1;
      for (int step = 0; step <= 2000; ++step) {
        const survey::Vector3 p = start + (end - start) * (step / 2000.0);
        if (p.x < 0 || p.y < 0 || p.z < 0 || p.x >= 69 || p.y >= 49 || p.z >= 60) continue;
        const int here = rank[slot({static_cast<std::int64_t>(p.x / 8), static_cast<std::int64_t>(p.y / 4),
                                    static_cast<std::int64_t>(p.z / 8)})];
        if (here < 0) continue;
        ASSERT_GE(here, last) << "view " << view << ", line " << line;
        last = here;
      }
    }
  }
}

TEST(Octree, TheViewpointIsTakenBackToIndexSpace) {
  const render::Placement placement{{0, 12.5, 0, 25, 3, 0, 0, 0, -4}, {100, -50, 7}};
  render::Camera camera;
  camera.eye = placement({3.5, -20, 11});
  camera.forward = placement({1, 2, -2}) - placement({0, 0, 0});
  camera.perspective = true;
  const survey::Vector3 eye = viewpoint_of(camera, placement).place;
  EXPECT_NEAR(eye.x, 3.5, 1e-9);
  EXPECT_NEAR(eye.y, -20, 1e-9);
  EXPECT_NEAR(eye.z, 11, 1e-9);
  camera.perspective = false;
  const survey::Vector3 along = viewpoint_of(camera, placement).place;
  EXPECT_NEAR(along.x, 1, 1e-9);
  EXPECT_NEAR(along.y, 2, 1e-9);
  EXPECT_NEAR(along.z, -2, 1e-9);
  EXPECT_THROW(viewpoint_of(camera, {{1, 0, 0, 2, 0, 0, 0, 0, 1}, {}}), Error);
}

TEST(Octree, RefusesLeavesOfAnotherVolume) {
  const Volume volume = wavy({17, 9, 9});
  const BrickRanges bricks = brick_ranges(volume.field(), 1);
  EXPECT_THROW(Octree(bricks.tables(), {18, 9, 9}), Error);
  EXPECT_THROW(Octree(bricks.tables(), {17, 9, 9}, {4, 8, 8}), Error);
  EXPECT_THROW(leaf_ranges(volume.field(), {0, 8, 8}, 1), Error);
}

}  // namespace
}  // namespace footwall::isosurface
