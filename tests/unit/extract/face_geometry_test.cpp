#include "engine/extract/face_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

survey::Geometry depth_survey() {
  survey::Geometry geometry;
  geometry.inlines.count = geometry.crosslines.count = geometry.samples = 100;
  geometry.domain = survey::Domain::kDepth;
  geometry.vertical_unit = survey::VerticalUnit::kMetre;
  geometry.interval = 5;
  // Inlines 25 m apart towards north, crosslines 12.5 m apart towards east.
  geometry.map = {.origin_x = 1000,
                  .origin_y = 2000,
                  .per_inline_x = 0,
                  .per_inline_y = 25,
                  .per_crossline_x = 12.5,
                  .per_crossline_y = 0};
  return geometry;
}

survey::LatticePoint at(int i, int j, int k) {
  return {i * 256, j * 256, k * 256};
}

TEST(FaceGeometry, AFaceThatFallsToTheEastDipsToTheEast) {
  // 8 crosslines = 100 m east, 20 samples = 100 m down: 45 degrees.
  const survey::LatticeTriangle triangle{at(0, 0, 0), at(4, 0, 0), at(0, 8, 20)};
  for (const auto& each : {triangle, survey::LatticeTriangle{triangle[0], triangle[2], triangle[1]}}) {
    const FaceGeometry face = face_geometry(depth_survey(), each);
    EXPECT_NEAR(face.dip, 45, 1e-12);
    EXPECT_NEAR(face.dip_azimuth, 90, 1e-12);
    EXPECT_NEAR(face.area, 0.5 * 100 * std::sqrt(2.0) * 100, 1e-9);
    EXPECT_NEAR(face.normal_i * face.normal_i + face.normal_j * face.normal_j + face.normal_k * face.normal_k,
                1, 1e-15);
  }
}

TEST(FaceGeometry, AgreesWithTheLibraryForRandomFaces) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int32_t> position(-25600, 25600);
  const survey::Geometry geometry = depth_survey();
  for (int n = 0; n < 2000; ++n) {
    survey::LatticeTriangle triangle;
    for (auto& p : triangle) p = {position(random), position(random), position(random)};
    const FaceGeometry face = face_geometry(geometry, triangle);
    double e[2][3];
    for (int edge = 0; edge < 2; ++edge) {
      const auto& to = triangle[static_cast<std::size_t>(edge) + 1];
      e[edge][0] = (to.j - triangle[0].j) / 256.0 * 12.5;
      e[edge][1] = (to.i - triangle[0].i) / 256.0 * 25;
      e[edge][2] = -(to.k - triangle[0].k) / 256.0 * 5;  // up
    }
    double normal[3] = {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                        e[0][0] * e[1][1] - e[0][1] * e[1][0]};
    if (normal[2] < 0) {
      for (double& c : normal) c = -c;
    }
    const double horizontal = std::hypot(normal[0], normal[1]);
    EXPECT_NEAR(face.area, std::hypot(horizontal, normal[2]) / 2, 1e-9 * face.area);
    EXPECT_NEAR(face.dip, std::atan2(horizontal, normal[2]) / kDegree, 1e-11);
    double azimuth = std::atan2(normal[0], normal[1]) / kDegree;
    if (azimuth < 0) azimuth += 360;
    EXPECT_NEAR(face.dip_azimuth, azimuth, 1e-10);
  }
}

TEST(FaceGeometry, ATimeSurveyNeedsAVelocityForMetres) {
  survey::Geometry geometry = depth_survey();
  geometry.domain = survey::Domain::kTime;
  geometry.vertical_unit = survey::VerticalUnit::kMillisecond;
  geometry.interval = 4;
  const survey::LatticeTriangle triangle{at(0, 0, 0), at(4, 0, 0), at(0, 8, 25)};
  const FaceGeometry blind = face_geometry(geometry, triangle);
  EXPECT_TRUE(std::isnan(blind.area));
  EXPECT_TRUE(std::isnan(blind.dip));
  EXPECT_NEAR(blind.dip_azimuth, 90, 1e-12);
  EXPECT_NEAR(blind.area_voxels, 0.5 * 4 * std::sqrt(8.0 * 8 + 25 * 25), 1e-12);
  // 25 samples of 4 ms are 100 ms two-way: 100 m at 2000 m/s.
  EXPECT_NEAR(face_geometry(geometry, triangle, 2000).dip, 45, 1e-12);
  EXPECT_THROW(face_geometry(geometry, triangle, 0), Error);
  EXPECT_THROW(face_geometry(geometry, triangle, kUndefined), Error);
}

TEST(FaceGeometry, SpecialFacesAreHonest) {
  const survey::Geometry geometry = depth_survey();
  const FaceGeometry flat = face_geometry(geometry, {at(0, 0, 5), at(9, 0, 5), at(0, 9, 5)});
  EXPECT_EQ(flat.dip, 0);
  EXPECT_TRUE(std::isnan(flat.dip_azimuth));
  const FaceGeometry upright = face_geometry(geometry, {at(0, 0, 0), at(9, 0, 0), at(0, 0, 9)});
  EXPECT_EQ(upright.dip, 90);
  const FaceGeometry line = face_geometry(geometry, {at(0, 0, 0), at(1, 1, 1), at(2, 2, 2)});
  EXPECT_EQ(line.area, 0);
  EXPECT_EQ(line.area_voxels, 0);
  EXPECT_TRUE(std::isnan(line.dip));
  EXPECT_TRUE(std::isnan(line.normal_i));
}

}  // namespace
}  // namespace footwall::extract
