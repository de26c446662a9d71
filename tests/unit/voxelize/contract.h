// What every voxelizer promises (engine/voxelize/rows.h), checked on one triangle.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/voxelize/exact.h"
#include "engine/voxelize/rows.h"
#include "unit/voxelize/triangles.h"

namespace footwall::voxelize {

inline constexpr survey::Box kEverywhere = {{-(1 << 25), -(1 << 25), -(1 << 25)},
                                            {1 << 25, 1 << 25, 1 << 25}};

// The voxels of the rows in their order, as they must come: strictly ascending in (v, u, w).
class CheckedRows final : public RowSink {
 public:
  void row(const Row& row) override {
    ASSERT_EQ(row.lo.size(), row.hi.size());
    ASSERT_FALSE(row.lo.empty());
    ASSERT_EQ(row.u_axis + row.v_axis + row.w_axis, 3);
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        const survey::Index at = {row.v, row.u0 + static_cast<std::int64_t>(n), w};
        if (!voxels.empty()) {
          ASSERT_LT(last_, at);
        }
        last_ = at;
        Voxel voxel{};
        voxel[static_cast<std::size_t>(row.v_axis)] = static_cast<std::int32_t>(at[0]);
        voxel[static_cast<std::size_t>(row.u_axis)] = static_cast<std::int32_t>(at[1]);
        voxel[static_cast<std::size_t>(row.w_axis)] = static_cast<std::int32_t>(at[2]);
        voxels.push_back(voxel);
      }
    }
  }
  std::vector<Voxel> voxels;

 private:
  survey::Index last_{};
};

inline std::vector<Voxel> in_rows(Voxelizer& voxelizer, const survey::LatticeTriangle& t,
                                  const survey::Box& box) {
  CheckedRows rows;
  voxelizer.rows(t, box, rows);
  return rows.voxels;
}

inline std::vector<Voxel> voxels_of(Voxelizer& voxelizer, const survey::LatticeTriangle& t,
                                    const survey::Box& box) {
  std::vector<Voxel> voxels = in_rows(voxelizer, t, box);
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

// Inside the bounding box; cut anywhere, also outside of it, the eight parts hold the whole's voxels in the
// whole's order.
inline void expect_contract(Voxelizer& voxelizer, const survey::LatticeTriangle& t, Numbers& numbers) {
  const survey::Box whole = bounding_voxels(t);
  const std::vector<Voxel> all = in_rows(voxelizer, t, kEverywhere);
  survey::Index cut;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cut[axis] = numbers.within(whole.lo[axis] - 1, whole.hi[axis] + 1);
  const auto part_of = [&](const Voxel& voxel) {
    int part = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) part |= voxel[axis] >= cut[axis] ? 1 << axis : 0;
    return part;
  };
  std::array<std::vector<Voxel>, 8> expected;
  for (const Voxel& voxel : all) {
    ASSERT_TRUE(whole.contains({voxel[0], voxel[1], voxel[2]})) << text_of(t);
    expected[static_cast<std::size_t>(part_of(voxel))].push_back(voxel);
  }
  for (int part = 0; part < 8; ++part) {
    survey::Box box = survey::grown(whole, 3);
    for (std::size_t axis = 0; axis < 3; ++axis)
      (((part >> axis) & 1) != 0 ? box.lo : box.hi)[axis] = cut[axis];
    ASSERT_EQ(in_rows(voxelizer, t, box), expected[static_cast<std::size_t>(part)]) << part << text_of(t);
  }
  std::vector<Voxel> raster;
  voxelizer.raster(t, kEverywhere, raster);
  std::sort(raster.begin(), raster.end());
  ASSERT_EQ(raster, voxels_of(voxelizer, t, kEverywhere)) << text_of(t);
}

}  // namespace footwall::voxelize
