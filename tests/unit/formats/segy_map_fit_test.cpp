#include "storage/formats/segy/map_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace footwall::formats::segy {
namespace {

TEST(SegyMapFit, FindsTheMapAtUtmSize) {
  Moments moments;
  for (int u = 0; u < 300; ++u) {
    for (int v = 0; v < 200; ++v) {
      moments.add(10000 + u, 2000 + 2 * v, 436400.25 + 12.4 * u - 1.7 * v, 6477000.5 + 1.7 * u + 12.4 * v);
    }
  }
  const MapFit fit = fit_map(moments);
  ASSERT_EQ(fit.kind, MapFit::Kind::kPlane);
  EXPECT_NEAR(fit.per_u_x, 12.4, 1e-9);
  EXPECT_NEAR(fit.per_u_y, 1.7, 1e-9);
  EXPECT_NEAR(fit.per_v_x, -0.85, 1e-9);
  EXPECT_NEAR(fit.per_v_y, 6.2, 1e-9);
  EXPECT_NEAR(fit.origin_x, 436400.25, 1e-6);
  EXPECT_NEAR(fit.origin_y, 6477000.5, 1e-6);
  EXPECT_LT(fit.residual, 1e-4);
}

TEST(SegyMapFit, ResidualIsTheRootMeanSquareDistance) {
  Moments moments;
  for (int u = 0; u < 100; ++u) {
    for (int v = 0; v < 100; ++v) {
      const double jitter = (u + v) % 2 == 0 ? 0.3 : -0.3;
      moments.add(u, v, 5e5 + 25.0 * u + jitter, 6e6 + 25.0 * v + jitter);
    }
  }
  EXPECT_NEAR(fit_map(moments).residual, 0.3 * std::sqrt(2.0), 1e-3);
}

TEST(SegyMapFit, TellsWhatCannotBeFitted) {
  EXPECT_EQ(fit_map({}).kind, MapFit::Kind::kUnusable);
  Moments one, along_crossline, along_inline, diagonal, collinear, unmoved;
  one.add(5, 6, 100, 200);
  for (int n = 0; n < 50; ++n) {
    along_crossline.add(5, n, 100 + 3 * n, 200 + 4 * n);
    along_inline.add(n, 6, 100 - 4 * n, 200 + 3 * n);
    diagonal.add(n, n, 100 + n, 200 + n);
    collinear.add(n % 7, n / 7, 100 + 3.0 * n, 200 + 6.0 * n);
    unmoved.add(n % 7, n / 7, 100, 200);
  }
  EXPECT_EQ(fit_map(one).kind, MapFit::Kind::kPoint);
  EXPECT_EQ(fit_map(along_crossline).kind, MapFit::Kind::kInline);
  EXPECT_EQ(fit_map(along_inline).kind, MapFit::Kind::kCrossline);
  EXPECT_EQ(fit_map(diagonal).kind, MapFit::Kind::kUnusable);
  EXPECT_EQ(fit_map(collinear).kind, MapFit::Kind::kUnusable);
  EXPECT_EQ(fit_map(unmoved).kind, MapFit::Kind::kUnusable);
}

}  // namespace
}  // namespace footwall::formats::segy
