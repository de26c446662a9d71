#include "storage/formats/gocad_tsurf.h"

#include <cmath>

#include "real_files.h"
#include "storage/base/error.h"

namespace footwall::formats {
namespace {

// Every TSurf of the manifest has the vertices and triangles that it states.
TEST(RealTsurf, VerticesAndTrianglesAsTheManifestStates) {
  FOOTWALL_NEEDS_REAL_FILES();
  int checked = 0;
  for (const RealFile& file : manifest()) {
    const std::string stated_vertices = stated_after(file.facts, "TSurf v=");
    const std::string stated_triangles = stated_after(file.facts, " t=");
    if (file.category != "fault" || stated_vertices.empty() || stated_triangles.empty()) continue;
    const auto read = gocad_tsurf::read(file.path);
    std::size_t vertices = 0, triangles = 0;
    for (const survey::Surface& surface : read.surfaces) {
      vertices += surface.vertices.size();
      triangles += surface.triangles.size();
    }
    EXPECT_EQ(vertices, std::stoul(stated_vertices)) << file.path;
    EXPECT_EQ(triangles, std::stoul(stated_triangles)) << file.path;
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(RealTsurf, DepthAndElevationBothComeOutPositiveDown) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder =
      real_files() / "OPM+ResInsight/ApplicationLibCode/UnitTests/TestData/RifSurfaceImporter";
  const auto depth = gocad_tsurf::read(folder / "tsurf_eks.ts");
  EXPECT_EQ(depth.surfaces.at(0).name, "MF_027_SU");
  EXPECT_EQ(depth.surfaces[0].vertices[0], (survey::WorldPoint{458177.767090, 7322538.712891, 1643.655884}));
  const auto elevation = gocad_tsurf::read(folder / "geom_with_properties.ts");
  EXPECT_EQ(elevation.surfaces.at(0).name, "Fault 12 Norne");
  EXPECT_EQ(elevation.surfaces[0].vertices[0],
            (survey::WorldPoint{456333.922152, 7319649.059718, 2494.290327}));
}

}  // namespace
}  // namespace footwall::formats
