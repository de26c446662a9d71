#include "engine/extract/cost/cover.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/voxelize/exact.h"
#include "random_faces.h"

namespace footwall::extract {
namespace {

TEST(Cover, OfALargeFaceInAPlaneIsAreaAndSidesAndOne) {
  // A right triangle with legs of 10 and 20 voxels across axis 2.
  const Shape shape = shape_of({survey::LatticePoint{0, 0, 0}, {2560, 0, 0}, {0, 5120, 0}});
  EXPECT_EQ(shape.area, (std::array<double, 3>{0, 0, 100}));
  EXPECT_EQ(shape.side, (std::array<double, 3>{10, 20, 0}));
  EXPECT_EQ(expected_cover(shape, {1, 1, 1}), 1 + 30 + 100);
  // a b c, then b c e_i + c a e_j + a b e_k, then c P_ij.
  EXPECT_EQ(expected_cover(shape, {2, 3, 4}), 24 + (3 * 4 * 10 + 4 * 2 * 20) + 4 * 100);
  EXPECT_EQ(expected_bounding(shape), 11 * 21 * 1);
}

// The definition: voxelize, put blocks around the voxels, count.
TEST(Cover, AgreesWithVoxelizedFacesOnAverage) {
  const survey::Index dims{300, 300, 300};
  const std::vector<Face> faces = random_faces(dims, 60, 30, 5);
  voxelize::ExactScratch scratch;
  const survey::Box box{{-10, -10, -10}, {310, 310, 310}};
  for (const std::int64_t side : {1, 2, 4}) {
    double expected = 0;
    double counted = 0;
    for (const Face& face : faces) {
      const auto length = static_cast<double>(side);
      expected += expected_cover(shape_of(face.triangle), {length, length, length});
      std::set<survey::Index> voxels;
      voxelize::for_each_voxel(face.triangle, box, scratch, [&](const survey::Index& p) {
        for (std::int64_t i = 0; i < side; ++i) {
          for (std::int64_t j = 0; j < side; ++j) {
            for (std::int64_t k = 0; k < side; ++k) voxels.insert({p[0] + i, p[1] + j, p[2] + k});
          }
        }
      });
      counted += static_cast<double>(voxels.size());
    }
    EXPECT_NEAR(counted / expected, 1, 0.02) << side;
  }
}

}  // namespace
}  // namespace footwall::extract
