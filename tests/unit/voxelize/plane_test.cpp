#include "engine/voxelize/detail/plane.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/voxelize/triangles.h"

namespace footwall::voxelize::detail {
namespace {

constexpr std::int32_t kNone = 1 << 30;

std::int64_t value_of(const FixedPlane& fixed, std::int64_t base, std::int64_t u, std::int64_t v) {
  const auto grown = static_cast<std::uint64_t>(base) +
                     static_cast<std::uint64_t>(fixed.slope_u) * static_cast<std::uint64_t>(u - fixed.u_mid) +
                     static_cast<std::uint64_t>(fixed.slope_v) * static_cast<std::uint64_t>(v - fixed.v_mid);
  return fixed.w_ref + (static_cast<std::int64_t>(grown) >> fixed.shift);
}

TEST(Plane, FixedPointEqualsStepsOf128Bits) {
  Numbers numbers(31);
  int used = 0;
  for (int round = 0; round < 300; ++round) {
    const auto extent = static_cast<std::int32_t>((std::int64_t{1} << numbers.within(8, 30)) - 1);
    const Corners corners = corners_of(make_triangle(kAllKinds[round % 5], extent, {11, 12, 13}, numbers));
    const auto normal = normal_of(corners);
    int w = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (magnitude(normal[axis]) > magnitude(normal[w])) w = axis;
    }
    if (normal[w] == 0) continue;
    const Plane plane = plane_of(corners, normal, (w + 1) % 3, (w + 2) % 3, w);
    const std::int64_t u0 = corners[0][(w + 1) % 3] / 256 - 20;
    const std::int64_t v0 = corners[0][(w + 2) % 3] / 256 - 20;
    FixedPlane fixed;
    if (!to_fixed(plane, u0, 41, v0, 41, fixed)) continue;
    ++used;
    for (std::int64_t v = v0; v < v0 + 41; ++v) {
      std::vector<std::int32_t> lo(41, -kNone);
      std::vector<std::int32_t> hi(41, kNone);
      tighten(plane, u0, v, lo, hi);
      for (std::int64_t n = 0; n < 41; ++n) {
        ASSERT_EQ(value_of(fixed, fixed.base_lo, u0 + n, v), lo[n]);
        ASSERT_EQ(value_of(fixed, fixed.base_hi, u0 + n, v), hi[n]);
      }
    }
  }
  EXPECT_GT(used, 150);
}

TEST(Plane, FixedPointSufficesFor2048Voxels) {
  constexpr std::int64_t kEnd = 2047 * 256;
  const Corners corners = {{{0, 0, 0}, {0, kEnd, kEnd - 1}, {kEnd, 1, kEnd}}};
  const auto normal = normal_of(corners);
  for (int w = 0; w < 3; ++w) {
    FixedPlane fixed;
    const Plane plane = plane_of(corners, normal, (w + 1) % 3, (w + 2) % 3, w);
    if (magnitude(plane.n_u) > plane.d || magnitude(plane.n_v) > plane.d) continue;
    EXPECT_TRUE(to_fixed(plane, 0, 2048, 0, 2048, fixed));
  }
  const Corners square = {{{0, 0, 0}, {0, kEnd, 0}, {0, 0, kEnd}}};
  FixedPlane fixed;
  EXPECT_TRUE(to_fixed(plane_of(square, normal_of(square), 2, 1, 0), 0, 2048, 0, 2048, fixed));
}

}  // namespace
}  // namespace footwall::voxelize::detail
