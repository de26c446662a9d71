#include "engine/verify/voxel_oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "unit/voxelize/triangles.h"

namespace footwall::verify {
namespace {

using survey::LatticeTriangle;

// The definition once more, by other means: the triangle, cut in turn by the six half-spaces of the cube, is
// not empty. Corners of the cut polygon are rational: homogeneous integers in units that grow with each cut.
// Doubles would do but for touching; integers within +-2^9 stay below 2^127 through six cuts.
using Integer = __int128_t;
struct Rational {
  std::array<Integer, 3> x;
  Integer scale;  // > 0
};

Integer common_divisor(Integer a, Integer b) {
  while (b != 0) {
    const Integer rest = a % b;
    a = b;
    b = rest;
  }
  return a < 0 ? -a : a;
}

bool cut_is_not_empty(const LatticeTriangle& triangle, const survey::Index& voxel) {
  std::vector<Rational> polygon;
  for (const auto& p : triangle) {
    polygon.push_back({{p.i - 256 * voxel[0], p.j - 256 * voxel[1], p.k - 256 * voxel[2]}, 1});
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      // Inside: side * x <= 128, that is inside(p) >= 0.
      const auto inside = [&](const Rational& p) { return 128 * p.scale - side * p.x[axis]; };
      std::vector<Rational> kept;
      for (std::size_t n = 0; n < polygon.size(); ++n) {
        const Rational& p = polygon[n];
        const Rational& q = polygon[(n + 1) % polygon.size()];
        const Integer at_p = inside(p);
        const Integer at_q = inside(q);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
          // With positions X = x/scale and distances D = at/scale: (X_p D_q - X_q D_p) / (D_q - D_p).
          Rational cut;
          cut.scale = at_q * p.scale - at_p * q.scale;
          for (int c = 0; c < 3; ++c) cut.x[c] = p.x[c] * at_q - q.x[c] * at_p;
          Integer divisor = cut.scale;
          for (const Integer x : cut.x) divisor = common_divisor(divisor, x);
          if (cut.scale < 0) divisor = -divisor;
          cut.scale /= divisor;
          for (Integer& x : cut.x) x /= divisor;
          kept.push_back(cut);
        }
      }
      polygon = kept;
      if (polygon.empty()) return false;
    }
  }
  return true;
}

TEST(VoxelOracle, AgreesWithCuttingTheTriangleByTheCube) {
  voxelize::Numbers numbers(11);
  std::int64_t met = 0;
  for (int round = 0; round < 300; ++round) {
    for (const auto kind : voxelize::kAllKinds) {
      const auto t = voxelize::make_triangle(kind, 500, {0, 0, 0}, numbers);
      survey::Index voxel;
      for (voxel[0] = -2; voxel[0] <= 2; ++voxel[0]) {
        for (voxel[1] = -2; voxel[1] <= 2; ++voxel[1]) {
          for (voxel[2] = -2; voxel[2] <= 2; ++voxel[2]) {
            const bool expected = cut_is_not_empty(t, voxel);
            met += expected ? 1 : 0;
            ASSERT_EQ(meets(t, voxel), expected)
                << voxelize::text_of(t) << " at " << voxel[0] << "," << voxel[1] << "," << voxel[2];
          }
        }
      }
    }
  }
  EXPECT_GT(met, 10000);
}

TEST(VoxelOracle, TouchingCounts) {
  const LatticeTriangle corner = {{{128, 128, 128}, {128, 128, 128}, {128, 128, 128}}};
  EXPECT_EQ(voxels_by_definition(corner, {{-1, -1, -1}, {3, 3, 3}}).size(), 8u);
  const LatticeTriangle beyond = {{{129, 128, 128}, {129, 128, 128}, {129, 128, 128}}};
  EXPECT_EQ(voxels_by_definition(beyond, {{-1, -1, -1}, {3, 3, 3}}).size(), 4u);
}

}  // namespace
}  // namespace footwall::verify
