#include "engine/render/fault_picture.h"

#include <gtest/gtest.h>

#include "engine/render/best_view.h"
#include "engine/render/fault_contact.h"
#include "engine/render/fault_lines.h"
#include "engine/render/overlay.h"
#include "storage/base/error.h"
#include "unit/render/sample_scene.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 480;
constexpr int kHeight = 300;

std::size_t pixels_like(const Picture& p, Rgba colour, int tolerance) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < p.rgba.size(); n += 4) {
    const auto differs = [&](std::size_t c, unsigned v) {
      return std::abs(static_cast<int>(p.rgba[n + c]) - static_cast<int>(v));
    };
    count +=
        std::max({differs(0, red(colour)), differs(1, green(colour)), differs(2, blue(colour))}) <= tolerance
            ? 1
            : 0;
  }
  return count;
}

TEST(FaultPicture, ShowsEveryFaultItsOutlineAndSection) {
  const FaultPicture what = sample::scene();
  const Composition made = compose(what, kWidth, kHeight);
  EXPECT_EQ(made.scene.meshes.size(), 3U);
  EXPECT_EQ(made.scene.sections.size(), 1U);
  ASSERT_EQ(made.scene.bars.size(), 2U);
  EXPECT_EQ(made.scene.bars[1].title, "amplitude variance");
  EXPECT_TRUE(made.scene.bars[1].has_undefined);
  EXPECT_NEAR(made.scene.bars[0].range.lo, -made.scene.bars[0].range.hi, 1e-12);
  EXPECT_EQ(made.scene.legend.size(), 3U);
  std::vector<std::string> texts;
  for (const Label& label : made.scene.labels) texts.push_back(label.text);
  for (const char* expected : {"F1 main", "F2 listric", "F3 twisted", "inline 545", "inline", "crossline",
                               "time (ms)", "400", "1200"}) {
    EXPECT_NE(std::find(texts.begin(), texts.end(), expected), texts.end()) << expected;
  }
  const Picture p = draw(what, 2 * kWidth, 2 * kHeight, 1);  // large enough for lines of full colour
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_GT(pixels_like(p, fault_colour(n), 30), 100U) << "outline of fault " << n;
  std::size_t surface = 0;
  for (const float d : p.depth) surface += d < 1 ? 1 : 0;
  EXPECT_GT(surface, p.depth.size() / 8);
}

TEST(FaultPicture, FaultsWithoutValuesShowTheirOwnColourAndNoBar) {
  FaultPicture what = sample::scene();
  what.sections.clear();
  for (FaultMesh& fault : what.faults) fault.values.clear();
  what.faults[1].values.assign(what.faults[1].triangles.size(), NAN);
  what.faults[0].colour = hex(0xff00ff);
  const Composition made = compose(what, kWidth, kHeight);
  EXPECT_TRUE(made.scene.bars.empty());
  EXPECT_EQ(made.scene.meshes[0].face_colours[5], hex(0xff00ff));
  EXPECT_EQ(made.scene.meshes[1].face_colours[5], fault_colour(1));
  EXPECT_TRUE(made.scene.meshes[1].face_hatched.empty());
}

TEST(FaultPicture, NullFacesAreHatchedAmongOthers) {
  const Composition made = compose(sample::scene(), kWidth, kHeight);
  EXPECT_EQ(made.scene.meshes[2].face_hatched[0], 1);
  EXPECT_EQ(made.scene.meshes[2].face_colours[0], ColourMap::kUndefined);
  EXPECT_EQ(made.scene.meshes[2].face_hatched[100], 0);
}

TEST(FaultPicture, TheBoxAndItsLabelsTakeTheRoomBesideThePanels) {
  FaultPicture what = sample::scene();
  for (const double azimuth : {-1.0, 0.0, 40.0, 133.0, 250.0, 320.0}) {
    what.view.azimuth_degrees = azimuth < 0 ? std::nullopt : std::optional(azimuth);
    for (const auto& [width, height] : {std::pair{1600, 1000}, std::pair{800, 600}, std::pair{2400, 1500}}) {
      const Composition made = compose(what, width, height);
      const double s = made.scene.text_scale;
      const SceneFrame frame(what.geometry, SceneFrame::pleasing_exaggeration(what.geometry, 0), 0);
      const auto place = [&, w = width, h = height](const Vec3& p) {
        const Vec4 clip = made.camera.clip_of(p);
        return std::pair{(clip.x / clip.w * 0.5 + 0.5) * w, (0.5 - clip.y / clip.w * 0.5) * h};
      };
      const double right = width - kPanelWidth * s;
      double least[2] = {1e9, 1e9};
      double most[2] = {-1e9, -1e9};
      for (const Vec3& corner : frame.corners()) {
        const auto [x, y] = place(corner);
        EXPECT_GT(x, 0);
        EXPECT_LT(x, right);
        EXPECT_GT(y, 80 * s) << "below the title";
        EXPECT_LT(y, height);
        least[0] = std::min(least[0], x);
        most[0] = std::max(most[0], x);
        least[1] = std::min(least[1], y);
        most[1] = std::max(most[1], y);
      }
      EXPECT_GT(std::max((most[0] - least[0]) / right, (most[1] - least[1]) / (height - 80 * s)), 0.75)
          << "the box is small at " << azimuth;
      const auto typeface = Typeface::find();
      if (!typeface) continue;
      for (const Label& label : made.scene.labels) {
        if (label.anchors.size() != 1) continue;  // of an axis
        const double across = typeface->width(label.text, label.size, label.bold);
        const double share = label.align == Align::kLeft ? 0 : label.align == Align::kCentre ? 0.5 : 1;
        const auto [x, y] = place(label.anchors[0]);
        EXPECT_GT(x + label.shift_x - share * across, 0) << label.text;
        EXPECT_LT(x + label.shift_x + (1 - share) * across, right) << label.text;
        EXPECT_LT(y + label.shift_y + label.size / 2, height) << label.text;
      }
    }
  }
}

TEST(FaultPicture, DivergingMapsAreSymmetricAboutZero) {
  FaultPicture what = sample::scene();
  EXPECT_GT(compose(what, kWidth, kHeight).scene.bars[1].range.lo, 0);
  what.statistic.colours = &ColourMap::named("red-white-blue");
  const Range range = compose(what, kWidth, kHeight).scene.bars[1].range;
  EXPECT_EQ(range.lo, -range.hi);
  EXPECT_GT(range.hi, 0.3);
}

TEST(FaultPicture, PillarsAreLinesWithDots) {
  FaultPicture what = sample::scene();
  const std::size_t before = compose(what, kWidth, kHeight).scene.lines.size();
  const survey::Geometry g = sample::geometry();
  what.faults[0].pillars = {{g.world_of({20, 72, 20}), g.world_of({20, 124, 230})}, {}};
  const Composition made = compose(what, kWidth, kHeight);
  EXPECT_EQ(made.scene.lines.size(), before + 2);
  EXPECT_NO_THROW(draw(what, kWidth, kHeight, 1));
}

TEST(FaultPicture, CopesWithUglyInput) {
  FaultPicture what = sample::scene();
  what.faults[0].vertices[3].x = NAN;
  what.faults[1].vertices[0].z = 1e300;
  what.faults[2].triangles.clear();
  what.faults[2].values.clear();
  EXPECT_NO_THROW(draw(what, 60, 40, 1));
  what.faults.clear();
  what.sections.clear();
  what.geometry.inlines.count = what.geometry.crosslines.count = what.geometry.samples = 1;
  EXPECT_NO_THROW(draw(what, 60, 40, 1)) << "a survey of one voxel";
}

TEST(FaultPicture, RefusesWhatDoesNotFitByName) {
  FaultPicture what = sample::scene();
  what.faults[1].values.pop_back();
  try {
    compose(what, kWidth, kHeight);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("F2 listric"), std::string::npos) << error.message();
  }
  what = sample::scene();
  what.faults[0].triangles[0] = {0, 1, 1000000};
  EXPECT_THROW(compose(what, kWidth, kHeight), Error);
  what = sample::scene();
  what.sections[0].index = 251;
  EXPECT_THROW(compose(what, kWidth, kHeight), Error);
  what = sample::scene();
  what.view.elevation_degrees = 100;
  EXPECT_THROW(compose(what, kWidth, kHeight), Error);
}

TEST(FaultContact, IsTheLineOfBothSurfaces) {
  const FaultMesh one = sample::fault("A", 0, 200, 0, 200, 7, [](double, double k) { return 50 + k * 0.5; });
  const FaultMesh two =
      sample::fault("B", 20, 120, 0, 200, 5, [](double, double k) { return 150 - k * 0.5; });
  const SceneFrame frame(sample::geometry(), 1, 0);
  std::vector<std::vector<Vec3>> vertices;
  for (const FaultMesh* fault : {&one, &two}) {
    vertices.emplace_back();
    for (const survey::WorldPoint& p : fault->vertices) vertices.back().push_back(frame.scene_of(p));
  }
  vertices[0][0].x = NAN;  // a corner far from the contact
  const std::vector<Triangles> both{{vertices[0], one.triangles}, {vertices[1], two.triangles}};
  const std::vector<Vec3> contact = contacts_of(both);
  double total = 0;
  for (std::size_t n = 0; n + 1 < contact.size(); n += 2) total += length(contact[n + 1] - contact[n]);
  const Vec3 from = frame.scene_of(survey::IndexPoint{20, 100, 100});
  const Vec3 to = frame.scene_of(survey::IndexPoint{120, 100, 100});
  EXPECT_NEAR(total, length(to - from), 1e-3);
  for (const Vec3& p : contact) EXPECT_NEAR(length(cross(p - from, to - from)) / length(to - from), 0, 1e-3);
  EXPECT_TRUE(contacts_of(std::span(both).first(1)).empty());
  const std::vector<Triangles> same{both[1], both[1]};
  EXPECT_LT(contacts_of(same).size(), 10U * both[1].triangles.size())
      << "a surface on itself is no heap of lines";
}

// A wall along the crosslines, and sections that would hide it: the eye takes the opposite corner.
TEST(BestView, TurnsWithTheSurveyAndKeepsSectionsBehind) {
  for (const bool turned : {false, true}) {
    survey::Geometry g = sample::geometry();
    if (turned) {
      const survey::MapView map = g.map;
      g.map.per_inline_x = map.per_inline_y;
      g.map.per_inline_y = -map.per_inline_x;
      g.map.per_crossline_x = map.per_crossline_y;
      g.map.per_crossline_y = -map.per_crossline_x;
    }
    const SceneFrame frame(g, 1, 0);
    const auto plane = [&](int axis, double at) {
      Surface surface{{}, {{0, 1, 2}, {0, 2, 3}}};
      for (const auto& [a, k] : {std::pair{0.0, 0.0}, {250.0, 0.0}, {250.0, 250.0}, {0.0, 250.0}}) {
        const survey::IndexPoint p = axis == 0 ? survey::IndexPoint{at, a, k} : survey::IndexPoint{a, at, k};
        surface.positions.push_back(static_cast<Vec3f>(frame.scene_of(p)));
      }
      return surface;
    };
    const std::vector<Surface> faults{plane(0, 125)};
    const std::vector<Surface> sections{plane(0, 250), plane(1, 0)};
    const double azimuth = best_azimuth(frame, faults, sections, 25, true);
    EXPECT_EQ(azimuth, best_azimuth(frame, faults, sections, 25, true));
    const std::array<Vec3, 8> corners = frame.corners();
    const Camera camera = Camera::look(azimuth, 25, 1, corners, 1.5, true);
    EXPECT_GT(dot(corners[1] - corners[0], camera.forward), 0) << "the last inline is behind";
    EXPECT_LT(dot(corners[2] - corners[0], camera.forward), 0) << "the first crossline is behind";
  }
}

TEST(FaultLines, BorderIsEdgesOfOneTriangleAndCutsLieInThePlane) {
  const FaultMesh fault =
      sample::fault("F", 0, 100, 0, 100, 4, [](double, double k) { return 50 + k * 0.3; });
  const SceneFrame frame(sample::geometry(), 1, 0);
  std::vector<Vec3> vertices;
  std::vector<survey::IndexPoint> in_index;
  for (const survey::WorldPoint& p : fault.vertices) {
    vertices.push_back(frame.scene_of(p));
    in_index.push_back(sample::geometry().index_of(p));
  }
  EXPECT_EQ(border_of(vertices, fault.triangles).size(), 2U * 16U);
  double length_of_cut = 0;
  const std::vector<Vec3> cut = cut_of(frame, in_index, fault.triangles, 0, 40.5);
  for (std::size_t n = 0; n + 1 < cut.size(); n += 2) length_of_cut += length(cut[n + 1] - cut[n]);
  const Vec3 from = frame.scene_of(survey::IndexPoint{40.5, 50, 0});
  const Vec3 to = frame.scene_of(survey::IndexPoint{40.5, 80, 100});
  EXPECT_NEAR(length_of_cut, length(to - from), 1e-6);
  EXPECT_TRUE(cut_of(frame, in_index, fault.triangles, 0, 101).empty());
}

}  // namespace
}  // namespace footwall::render
