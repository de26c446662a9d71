#include "engine/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/render/scene_frame.h"
#include "storage/base/error.h"
#include "unit/render/sample_scene.h"

namespace footwall::render {
namespace {

const Bounds kBox{{-1000, -800, -300}, {1000, 800, 300}};

struct Place {
  double x, y, depth;
};
Place place(const Camera& camera, const Vec3& p) {
  const Vec4 clip = camera.clip_of(p);
  return {clip.x / clip.w, clip.y / clip.w, clip.z / clip.w * 0.5 + 0.5};
}

TEST(Camera, AzimuthZeroLooksNorthAndNinetyEast) {
  for (const bool perspective : {true, false}) {
    const Camera north = Camera::look(0, 20, 1, kBox, 1.6, perspective);
    EXPECT_LT(place(north, {0, -500, 0}).depth, place(north, {0, 500, 0}).depth) << "the south is near";
    EXPECT_GT(place(north, {500, 0, 0}).x, place(north, {-500, 0, 0}).x) << "the east is on the right";
    const Camera east = Camera::look(90, 20, 1, kBox, 1.6, perspective);
    EXPECT_LT(place(east, {-500, 0, 0}).depth, place(east, {500, 0, 0}).depth) << "the west is near";
    EXPECT_GT(place(east, {0, -500, 0}).x, place(east, {0, 500, 0}).x) << "the south is on the right";
    for (const Camera& camera : {north, east})
      EXPECT_GT(place(camera, {0, 0, 200}).y, place(camera, {0, 0, -200}).y);
  }
}

TEST(Camera, ElevationIsAboveTheHorizon) {
  const Camera above = Camera::look(0, 40, 1, kBox, 1, true);
  EXPECT_GT(above.eye.z, 300) << "the eye is high";
  EXPECT_LT(place(above, {0, 0, 300}).depth, place(above, {0, 0, -300}).depth);
  const Camera below = Camera::look(0, -40, 1, kBox, 1, true);
  EXPECT_GT(place(below, {0, 0, 300}).depth, place(below, {0, 0, -300}).depth);
  const Camera map = Camera::look(0, 90, 1, kBox, 1, false);
  EXPECT_GT(place(map, {0, 500, 0}).y, place(map, {0, -500, 0}).y) << "from straight above north is up";
}

TEST(Camera, ZoomOneFitsTheBoxFromEverywhere) {
  for (const bool perspective : {true, false}) {
    for (double azimuth = 0; azimuth < 360; azimuth += 35) {
      for (const double elevation : {-90.0, -30.0, 0.0, 25.0, 90.0}) {
        for (const double zoom : {1.0, 2.0}) {
          const Camera camera = Camera::look(azimuth, elevation, zoom, kBox, 1.5, perspective);
          double most = 0;
          for (unsigned corner = 0; corner < 8; ++corner) {
            const Place p =
                place(camera, {(corner & 1U) != 0 ? 1000. : -1000., (corner & 2U) != 0 ? 800. : -800.,
                               (corner & 4U) != 0 ? 300. : -300.});
            most = std::max({most, std::abs(p.x), std::abs(p.y)});
            EXPECT_GT(p.depth, 0);
            EXPECT_LT(p.depth, 1);
          }
          EXPECT_NEAR(most, Camera::kFill * zoom, 1e-9) << azimuth << " " << elevation;
        }
      }
    }
  }
}

TEST(Camera, DrawsIntoAPartOfThePicture) {
  const Camera whole = Camera::look(30, 20, 1, kBox, 1, true);
  const Camera part = whole.within(0, 0.5, 0.5, 1);
  const Vec3 p{300, -200, 100};
  EXPECT_NEAR(place(part, p).x, place(whole, p).x * 0.5 - 0.5, 1e-12);
  EXPECT_NEAR(place(part, p).y, place(whole, p).y * 0.5 - 0.5, 1e-12);
  EXPECT_NEAR(place(part, p).depth, place(whole, p).depth, 1e-12);
}

TEST(Camera, RefusesWhatCannotBe) {
  EXPECT_THROW(Camera::look(NAN, 0, 1, kBox, 1, true), Error);
  EXPECT_THROW(Camera::look(0, 91, 1, kBox, 1, true), Error);
  EXPECT_THROW(Camera::look(0, 0, 0, kBox, 1, true), Error);
  EXPECT_THROW(Camera::look(0, 0, 1, kBox, -1, true), Error);
}

TEST(SceneFrame, ThePleasingBoxIsABlock) {
  survey::Geometry g = sample::geometry();
  for (const std::int64_t samples : {40, 126, 251, 1200}) {
    g.samples = samples;
    const auto corners = SceneFrame(g, SceneFrame::pleasing_exaggeration(g, 0), 0).corners();
    const double height = length(corners[4] - corners[0]);
    const double width = std::max(length(corners[1] - corners[0]), length(corners[2] - corners[0]));
    EXPECT_GT(height, 0.48 * width) << samples;
    EXPECT_LT(height, 0.74 * width) << samples;
  }
  g.samples = 5000;
  EXPECT_EQ(SceneFrame::pleasing_exaggeration(g, 0), 1) << "high enough as it is";
}

TEST(SceneFrame, IsMetresEastNorthUpFromTheCentre) {
  survey::Geometry g = sample::geometry();
  const survey::WorldPoint centre = g.world_of({125, 125, 125});
  const SceneFrame time(g, 2, 0);
  const Vec3 p = time.scene_of(survey::WorldPoint{centre.x + 100, centre.y + 50, centre.z + 30});
  EXPECT_NEAR(p.x, 100, 1e-6);
  EXPECT_NEAR(p.y, 50, 1e-6);
  EXPECT_NEAR(p.z, -60, 1e-6) << "without a velocity 1 ms is 1 m; deeper is lower; exaggerated twice";
  EXPECT_NEAR(SceneFrame(g, 1, 3000).scene_of(survey::WorldPoint{centre.x, centre.y, centre.z + 30}).z, -45,
              1e-6);
  g.domain = survey::Domain::kDepth;
  g.vertical_unit = survey::VerticalUnit::kFoot;
  g.horizontal_unit = "ft";
  const Vec3 feet =
      SceneFrame(g, 1, 0).scene_of(survey::WorldPoint{centre.x + 100, centre.y, centre.z + 100});
  EXPECT_NEAR(feet.x, 30.48, 1e-6);
  EXPECT_NEAR(feet.z, -30.48, 1e-6);
  EXPECT_THROW(SceneFrame(g, 0, 0), Error);
  EXPECT_THROW(SceneFrame(g, 1, -5), Error);
}

TEST(Camera, LooksFromOnePlaceToAnother) {
  const std::array<Vec3, 2> box{Vec3{-100, -100, -50}, Vec3{100, 100, 50}};
  for (const bool perspective : {true, false}) {
    const Camera camera = Camera::look_at({0, -500, 200}, {0, 0, 0}, {0, 0, 1}, box, 1.5, perspective);
    const Vec4 target = camera.clip_of({0, 0, 0});
    EXPECT_NEAR(target.x / target.w, 0, 1e-12);
    EXPECT_NEAR(target.y / target.w, 0, 1e-12);
    EXPECT_GT(target.z / target.w, -1);
    EXPECT_LT(target.z / target.w, 1);
    // East is to the right, up is up, what is nearer has less depth.
    const Vec4 east = camera.clip_of({50, 0, 0});
    const Vec4 above = camera.clip_of({0, 0, 40});
    const Vec4 near = camera.clip_of({0, -100, 40});
    EXPECT_GT(east.x / east.w, 0.1);
    EXPECT_GT(above.y / above.w, 0.1);
    EXPECT_LT(near.z / near.w, target.z / target.w);
    // The cone's rim at the target's distance touches the picture's lesser side.
    const double rim =
        length(Vec3{0, -500, 200}) * std::tan(Camera::kConeDegrees / 2 * std::numbers::pi / 180);
    const Vec4 top = camera.clip_of(camera.up * rim);
    EXPECT_NEAR(top.y / top.w, 1, 1e-9);
  }
  EXPECT_THROW(Camera::look_at({1, 2, 3}, {1, 2, 3}, {0, 0, 1}, box, 1, true), Error);
  EXPECT_THROW(Camera::look_at({0, 0, 3}, {0, 0, 0}, {0, 0, 1}, box, 1, true), Error);
  EXPECT_THROW(Camera::look_at({NAN, 0, 3}, {0, 0, 0}, {0, 0, 1}, box, 1, true), Error);
}

}  // namespace
}  // namespace footwall::render
