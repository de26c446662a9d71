#include "engine/tasks/write_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "engine/isosurface/plane.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::tasks {
namespace {

using survey::Vector3;

isosurface::Surface ball() {
  constexpr std::int64_t kSize = 12;
  std::vector<float> values;
  for (std::int64_t i = 0; i < kSize; ++i) {
    for (std::int64_t j = 0; j < kSize; ++j) {
      for (std::int64_t k = 0; k < kSize; ++k) {
        values.push_back(4 - static_cast<float>(std::hypot(i - 5.4, j - 5.6, k - 5.3)));
      }
    }
  }
  isosurface::Surface surface;
  const survey::Index size{kSize, kSize, kSize};
  isosurface::extract_plane({values, size, {0, 0, 0}, size}, 0, {}, surface);
  return surface;
}

survey::Geometry geometry(bool left_handed) {
  survey::Geometry made;
  made.inlines.count = made.crosslines.count = made.samples = 12;
  made.z0 = 1200;
  made.interval = 4;
  // 12.5 and 25 m, turned.
  made.map = {458177, 7322538, 7.5, 10, left_handed ? 20. : -20., left_handed ? -15. : 15.};
  return made;
}

// In the frame of the file: the triangles run counter-clockwise seen from where the normals point, out of the
// ball, and the normals stand at right angles to them.
void expect_outward(const formats::TriangleSource& source) {
  std::vector<std::array<double, 3>> positions(source.vertices);
  std::vector<std::array<float, 3>> normals(source.vertices);
  std::vector<std::array<std::uint32_t, 3>> corners(source.triangles);
  source.positions(0, positions);
  source.normals(0, normals);
  source.corners(0, corners);
  Vector3 centre;
  for (const auto& [x, y, z] : positions)
    centre = centre + Vector3{x, y, z} * (1.0 / static_cast<double>(source.vertices));
  const auto at = [&](std::uint32_t n) { return Vector3{positions[n][0], positions[n][1], positions[n][2]}; };
  for (const auto& [a, b, c] : corners) {
    const Vector3 winding = cross(at(b) - at(a), at(c) - at(a));
    EXPECT_GT(dot(winding, at(a) - centre), 0);
    const Vector3 normal{normals[a][0], normals[a][1], normals[a][2]};
    EXPECT_NEAR(length(normal), 1, 1e-6);
    EXPECT_GT(dot(normal, at(a) - centre), 0);
    EXPECT_GT(dot(normal, winding) / length(winding), 0.65);  // within 50 degrees: the triangles are large
  }
}

TEST(WriteSurface, TrianglesFaceOutwardsInEveryFrame) {
  const isosurface::Surface surface = ball();
  ASSERT_GT(surface.triangles.size(), 100u);
  for (const bool left_handed : {false, true}) {
    for (const SurfaceFormat format : {SurfaceFormat::kVtp, SurfaceFormat::kTsurf}) {
      for (const SurfaceCoordinates coordinates : {SurfaceCoordinates::kWorld, SurfaceCoordinates::kIndex}) {
        const SurfaceFrame frame(geometry(left_handed), coordinates, format);
        expect_outward(source_of(surface, frame));
      }
    }
  }
}

TEST(WriteSurface, ZIsUpWhereViewersWantIt) {
  const isosurface::Point p{2, 3, 5.5};
  const SurfaceFrame up(geometry(false), SurfaceCoordinates::kWorld, SurfaceFormat::kPly);
  EXPECT_EQ(up.position(p), (std::array<double, 3>{458177 + 15 - 60, 7322538 + 20 + 45, -1222}));
  EXPECT_EQ(up.facts().z_positive, "up");
  EXPECT_EQ(up.facts().vertical_unit, "ms");
  const SurfaceFrame down(geometry(false), SurfaceCoordinates::kWorld, SurfaceFormat::kTsurf);
  EXPECT_EQ(down.position(p)[2], 1222);
  EXPECT_EQ(down.facts().z_positive, "down");
  const SurfaceFrame index(geometry(false), SurfaceCoordinates::kIndex, SurfaceFormat::kPly);
  EXPECT_EQ(index.position(p), (std::array<double, 3>{2, 3, 5.5}));
  EXPECT_EQ(index.facts().horizontal_unit, "voxel");
}

TEST(WriteSurface, TheSuffixNamesTheFormat) {
  const ScratchFolder folder;
  const isosurface::Surface surface = ball();
  for (const auto& [name, begin] : std::vector<std::pair<std::string, std::string>>{
           {"a.vtp", "<?xml"}, {"a.PLY", "ply\n"}, {"a.stl", "Footwall"}, {"a.ts", "GOCAD TSurf"}}) {
    write_surface(folder / name, surface, "amplitude = 0", geometry(false), SurfaceCoordinates::kWorld);
    EXPECT_EQ(content_of(folder / name).substr(0, begin.size()), begin);
  }
  const auto read_back = formats::gocad_tsurf::read(folder / "a.ts");
  ASSERT_EQ(read_back.objects.size(), 1u);
  EXPECT_EQ(read_back.objects[0].surface.triangles.size(), surface.triangles.size());
  EXPECT_THROW(write_surface(folder / "a.obj", surface, "", geometry(false), SurfaceCoordinates::kWorld),
               Error);
  EXPECT_THROW(surface_coordinates_from("World"), Error);
  survey::Geometry flat = geometry(false);
  flat.map.per_crossline_x = 3;
  flat.map.per_crossline_y = 4;
  EXPECT_THROW(write_surface(folder / "b.ply", surface, "", flat, SurfaceCoordinates::kWorld), Error);
}

}  // namespace
}  // namespace footwall::tasks
