#include "engine/extract/face_rows.h"

#include <gtest/gtest.h>

#include "engine/voxelize/exact.h"

namespace footwall::extract {
namespace {

TEST(FaceRows, GiveBackTheVoxelsInCanonicalOrder) {
  const survey::LatticeTriangle triangle{
      survey::LatticePoint{-700, 300, 100}, {5000, 900, 2600}, {800, 4000, 7000}};
  const survey::Box clip{{0, 0, 0}, {12, 14, 20}};
  voxelize::ExactScratch scratch;
  FaceRows rows;
  for (int round = 0; round < 2; ++round) {
    rows.clear();
    voxelize::exact_rows(triangle, clip, scratch, rows);
    std::vector<survey::Index> found;
    rows.for_each([&](const survey::Index& voxel) { found.push_back(voxel); });
    EXPECT_EQ(found, voxelize::list(triangle, clip, scratch));
    EXPECT_EQ(rows.voxels(), static_cast<std::int64_t>(found.size()));
    EXPECT_GT(found.size(), 100U);
  }
}

}  // namespace
}  // namespace footwall::extract
