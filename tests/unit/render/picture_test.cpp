#include "engine/render/picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "engine/render/axes.h"
#include "engine/render/overlay.h"
#include "engine/render/text_fit.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::render {
namespace {

const Bounds kBox{{-10, -10, -10}, {10, 10, 10}};

Rgba pixel(const Picture& p, int x, int y) {
  const std::uint8_t* at = &p.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) +
                                        static_cast<std::size_t>(x))];
  return rgb(at[0], at[1], at[2], at[3]);
}
float depth(const Picture& p, int x, int y) {
  return p
      .depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x)];
}

Scene empty_scene() {
  Scene scene;
  scene.north_arrow = false;
  return scene;
}

// A square facing south at northing y, half of the box wide.
ColouredMesh wall(float y, float half, Rgba colour) {
  ColouredMesh mesh;
  mesh.positions = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_colours = {colour, colour};
  mesh.lit = false;
  mesh.edges = false;
  return mesh;
}

TEST(Picture, ShowsTheNearestSurfaceAndItsDepth) {
  Scene scene = empty_scene();
  scene.meshes = {wall(5, 8, hex(0x00ff00)), wall(-5, 4, hex(0xff0000))};
  const Camera camera = Camera::look(0, 0, 1, kBox, 1, false);
  const Picture p = render(scene, camera, 100, 100, 1);
  EXPECT_EQ(pixel(p, 50, 50), hex(0xff0000));
  EXPECT_EQ(pixel(p, 50, 22), hex(0x00ff00));
  EXPECT_LT(depth(p, 50, 50), depth(p, 50, 22));
  EXPECT_EQ(depth(p, 1, 1), 1.0F);
  const Vec4 clip = camera.clip_of({0, -5, 0});
  EXPECT_NEAR(depth(p, 50, 50), clip.z / clip.w * 0.5 + 0.5, 1e-6);
}

TEST(Picture, SmoothsEdgesAndDoesNotDependOnThreads) {
  Scene scene = empty_scene();
  ColouredMesh mesh = wall(0, 7, hex(0xffffff));
  mesh.positions[2].x = 3;
  scene.meshes = {mesh};
  const Camera camera = Camera::look(20, 30, 1, kBox, 1, true);
  const Picture one = render(scene, camera, 90, 90, 1);
  const Picture two = render(scene, camera, 90, 90, 2);
  EXPECT_EQ(one.rgba, two.rgba);
  EXPECT_EQ(one.depth, two.depth);
  int between = 0;
  for (std::size_t n = 0; n < one.rgba.size(); n += 4)
    between += one.rgba[n] > 60 && one.rgba[n] < 240 ? 1 : 0;
  EXPECT_GT(between, 40) << "no smooth edge";
}

TEST(Picture, DrawsSectionsTexelForTexelAndLinesOfTheirWidth) {
  Scene scene = empty_scene();
  SectionPlane section;
  section.origin = {-5, 0, 5};
  section.along_rows = {10, 0, 0};
  section.along_columns = {0, 0, -10};
  section.rows = section.columns = 2;
  section.values = {0, 1, NAN, 0.5F};  // [east][down]
  section.colours = &ColourMap::named("grey");
  scene.sections = {section};
  scene.lines.push_back({{{-10, -1, 0}, {10, -1, 0}}, 3, hex(0x0000ff), 0.001, false});
  const Camera camera = Camera::look(0, 0, 1, kBox, 1, false);
  const Picture p = render(scene, camera, 100, 100, 1);
  EXPECT_EQ(pixel(p, 30, 30), hex(0x000000));
  EXPECT_EQ(pixel(p, 30, 70), hex(0xffffff));
  EXPECT_EQ(pixel(p, 70, 30), ColourMap::kUndefined);
  EXPECT_EQ(pixel(p, 70, 70), hex(0x808080));
  int blues = 0;
  for (int y = 40; y < 60; ++y) blues += pixel(p, 30, y) == hex(0x0000ff) ? 1 : 0;
  EXPECT_GE(blues, 2);
  EXPECT_LE(blues, 3);
}

// Texels of 7 pixels in front and 5 behind: a change from squares to blended within one section is a seam.
TEST(Picture, ASectionIsDrawnInOneManner) {
  Scene scene = empty_scene();
  SectionPlane section;
  section.origin = {-10, 10, 0};
  section.along_rows = {0.5, 0, 0};
  section.along_columns = {0, -0.5, 0};
  section.rows = section.columns = 40;
  for (int n = 0; n < 1600; ++n) section.values.push_back((n / 40 + n % 40) % 2 == 0 ? 0.0F : 1.0F);
  section.colours = &ColourMap::named("grey");
  scene.sections = {section};
  const Camera camera = Camera::look(0, 60, 1, kBox, 1, true);
  // Of pixels between black and white, as blended ones are and all but the rims of squares are not.
  const auto grey_share = [&](const Picture& p, int first, int last) {
    int grey = 0;
    int all = 0;
    for (int y = first; y < last; ++y) {
      for (int x = p.width * 2 / 5; x < p.width * 3 / 5; ++x) {
        const unsigned v = red(pixel(p, x, y));
        grey += v > 30 && v < 225 ? 1 : 0;
        ++all;
      }
    }
    return static_cast<double>(grey) / all;
  };
  for (const int size : {300, 340, 380, 420, 460, 500}) {
    const Picture p = render(scene, camera, size, size, 1);
    const double far = grey_share(p, size * 4 / 10, size / 2);
    const double near = grey_share(p, size / 2, size * 6 / 10);
    EXPECT_NEAR(far, near, 0.15) << size;
  }
}

TEST(Picture, LabelsAreDrawnWhereTheirPlaceIsSeen) {
  if (!Typeface::find()) GTEST_SKIP() << "no font on this machine";
  Scene scene = empty_scene();
  scene.meshes = {wall(-5, 6, hex(0x404040))};
  const Camera camera = Camera::look(0, 0, 1, kBox, 1, false);
  const Picture without = render(scene, camera, 200, 200, 1);
  scene.labels.push_back({"Störung", {{0, 5, 0}}, 0, 0, Align::kCentre, 14, hex(0xffffff), false});
  EXPECT_EQ(render(scene, camera, 200, 200, 1).rgba, without.rgba) << "behind the wall";
  scene.labels[0].anchors.push_back({0, -5, 0});
  const Picture with = render(scene, camera, 200, 200, 1);
  int changed = 0;
  for (int y = 80; y < 120; ++y) {
    for (int x = 60; x < 140; ++x) changed += pixel(with, x, y) != pixel(without, x, y) ? 1 : 0;
  }
  EXPECT_GT(changed, 100);
  EXPECT_EQ(with.depth, without.depth);
  // A second label in the same place gives way.
  scene.labels.push_back(scene.labels[0]);
  EXPECT_EQ(render(scene, camera, 200, 200, 1).rgba, with.rgba);
  // Nor does one stand in the title's place.
  Scene titled = empty_scene();
  titled.title = "A title as wide as the picture is";
  const Picture title_alone = render(titled, camera, 200, 200, 1);
  titled.labels.push_back({"F1", {{-8, -5, 9}}, 0, 0, Align::kCentre, 14, hex(0xffffff), false});
  EXPECT_EQ(render(titled, camera, 200, 200, 1).rgba, title_alone.rgba);
  // Bytes that are no text do not end the program.
  scene.labels = {{"\xff\xc3\x28 \xe2\x82", {{0, -5, 0}}, 0, 0, Align::kLeft, 14, hex(0xffffff), true}};
  EXPECT_NE(render(scene, camera, 200, 200, 1).rgba, without.rgba);
}

TEST(Picture, LinesThatReachFarBeyondThePictureAreStillDrawn) {
  Scene scene = empty_scene();
  scene.lines.push_back({{{-1e7, 0, 0}, {1e7, 0, 0}}, 4, hex(0xffffff), 0.001, false});
  scene.lines.push_back(
      {{{0, -1e5, -300}, {0, 5, 2}}, 4, hex(0xff0000), 0.001, false});  // from behind the eye
  const Picture p = render(scene, Camera::look(0, 0, 1, kBox, 1, true), 100, 100, 1);
  EXPECT_EQ(pixel(p, 2, 50), hex(0xffffff));
  EXPECT_EQ(pixel(p, 97, 50), hex(0xffffff));
  EXPECT_GT(red(pixel(p, 50, 40)), 200U);
  EXPECT_LT(green(pixel(p, 50, 40)), 100U);
}

TEST(Picture, WithoutAFontIsMadeWithoutWords) {
  Scene scene = empty_scene();
  scene.north_arrow = true;
  scene.legend.push_back({"F1", hex(0xff0000)});
  scene.title = "words";
  const Camera camera = Camera::look(0, 30, 1, kBox, 1.6, false);
  const auto config =
      std::filesystem::temp_directory_path() / fmt::format("footwall-no-fonts-{}.conf", ::getpid());
  write_whole_file(config, "<?xml version=\"1.0\"?><fontconfig></fontconfig>");
  ::setenv("FONTCONFIG_FILE", config.c_str(), 1);
  const bool found = Typeface::find() != nullptr;
  const Picture p = render(scene, camera, 320, 200, 1);
  ::unsetenv("FONTCONFIG_FILE");
  std::filesystem::remove(config);
  EXPECT_FALSE(found);
  bool swatch = false;
  for (std::size_t n = 0; n < p.rgba.size(); n += 4)
    swatch = swatch || (p.rgba[n] == 255 && p.rgba[n + 1] == 0);
  EXPECT_TRUE(swatch);
}

TEST(Picture, RefusesScenesThatDoNotFitTogether) {
  const Camera camera = Camera::look(0, 0, 1, kBox, 1, false);
  Scene scene = empty_scene();
  EXPECT_THROW(render(scene, camera, 0, 10, 1), Error);
  EXPECT_THROW(render(scene, camera, 10, kLargestPicture + 1, 1), Error);
  EXPECT_NO_THROW(render(scene, camera, 1, 1, 1));
  scene.meshes = {wall(0, 5, 0)};
  scene.meshes[0].face_colours.pop_back();
  EXPECT_THROW(render(scene, camera, 10, 10, 1), Error);
  scene = empty_scene();
  scene.sections.emplace_back();
  EXPECT_THROW(render(scene, camera, 10, 10, 1), Error);
}

TEST(Overlay, TickTextsTellTheRange) {
  const BarTicks plain = ticks_of({0, 0.4}, 5);
  EXPECT_EQ(plain.texts, (std::vector<std::string>{"0.00", "0.10", "0.20", "0.30", "0.40"}));
  EXPECT_EQ(plain.exponent, 0);
  const BarTicks large = ticks_of({-2e7, 2e7}, 5);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(large.texts.front(), "−20");
  EXPECT_EQ(large.texts[2], "0");
  EXPECT_EQ(ticks_of({1e-6, 5e-6}, 3).exponent, -6);
}

TEST(Overlay, TextKeepsToItsRoom) {
  const std::unique_ptr<Typeface> typeface = Typeface::find();
  if (!typeface) GTEST_SKIP() << "no font on this machine";
  EXPECT_EQ(fitted(*typeface, "F1 main", 15, false, 200), "F1 main");
  for (const double room : {15.0, 60.0, 123.0}) {
    const std::string text = fitted(*typeface, "Störungsfläche Nr. 12 östlich", 15, true, room);
    EXPECT_LE(typeface->width(text, 15, true), room) << text;
    EXPECT_TRUE(text.ends_with("…")) << text;
  }
  EXPECT_LE(typeface->width(fitted(*typeface, std::string(100'000, 'x'), 15, false, 99), 15), 99);
  const std::vector<std::string> lines =
      wrapped(*typeface, "amplitude²\nrun 12, volume amplitude of the second survey", 14, 194, 5);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "amplitude²");
  for (const std::string& line : lines) EXPECT_LE(typeface->width(line, 14), 194) << line;
  EXPECT_EQ(wrapped(*typeface, "a b c d e f", 14, 20, 2).size(), 2U);
  EXPECT_TRUE(wrapped(*typeface, "", 14, 20, 2).empty());
}

TEST(Axes, NumbersAreRoundAndInside) {
  EXPECT_EQ(round_numbers(300, 550, 5, 1), (std::vector<double>{300, 350, 400, 450, 500, 550}));
  EXPECT_EQ(round_numbers(3, 5, 10, 1), (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(round_numbers(7, 7, 5, 1), (std::vector<double>{7}));
  EXPECT_LE(round_numbers(1e18, 1e18 + 256, 5, 1e-3).size(), 1000U);
}

}  // namespace
}  // namespace footwall::render
