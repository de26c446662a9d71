#include "storage/formats/gocad_tsurf.h"

#include <cmath>
#include <limits>
#include <map>

#include "engine/mesh/surface_facts.h"
#include "real_files.h"
#include "storage/base/error.h"

namespace footwall::formats {
namespace {

// The surfaces of a file as one, for files of several objects.
survey::Surface whole(const gocad_tsurf::ReadResult& read) {
  survey::Surface all;
  for (const gocad_tsurf::Object& object : read.objects) {
    const auto first = static_cast<std::int32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), object.surface.vertices.begin(), object.surface.vertices.end());
    for (const auto& [a, b, c] : object.surface.triangles)
      all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

// Every TSurf of the manifest has what it states: vertices, triangles, pieces, loops, Euler number, area.
TEST(RealTsurf, FactsAsTheManifestStates) {
  FOOTWALL_NEEDS_REAL_FILES();
  int checked = 0;
  for (const RealFile& file : manifest()) {
    if (file.category != "fault" || stated_after(file.facts, "TSurf v=").empty()) continue;
    SCOPED_TRACE(file.path);
    const auto read = gocad_tsurf::read(file.path);
    EXPECT_EQ(read.report.rejected_count, 0);
    const mesh::SurfaceFacts facts = mesh::surface_facts(whole(read));
    const auto expect = [&](const std::string& mark, std::int64_t found) {
      const std::string stated = stated_after(file.facts, mark);
      if (!stated.empty()) {
        EXPECT_EQ(found, std::stoll(stated)) << mark;
      }
    };
    expect("TSurf v=", facts.vertices);
    expect(" t=", facts.faces);
    expect("comps=", facts.components);
    expect("loops=", facts.boundary_loops);
    expect("chi=", facts.euler);
    const std::string area = stated_after(file.facts, "area=");
    if (!area.empty()) {
      EXPECT_NEAR(facts.area / 1e6, std::stod(area), 0.00051);
    }
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(RealTsurf, DepthAndElevationBothComeOutPositiveDown) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder =
      real_files() / "OPM+ResInsight/ApplicationLibCode/UnitTests/TestData/RifSurfaceImporter";
  const auto depth = gocad_tsurf::read(folder / "tsurf_eks.ts");
  EXPECT_EQ(depth.objects.at(0).surface.name, "MF_027_SU");
  EXPECT_EQ(depth.objects[0].vertical_unit, "m");
  EXPECT_EQ(depth.objects[0].surface.vertices[0],
            (survey::WorldPoint{458177.767090, 7322538.712891, 1643.655884}));
  const auto elevation = gocad_tsurf::read(folder / "geom_with_properties.ts");
  EXPECT_EQ(elevation.objects.at(0).surface.name, "Fault 12 Norne");
  EXPECT_EQ(elevation.objects[0].properties, (std::vector<std::string>{"SX", "SY", "SV"}));
  EXPECT_EQ(elevation.objects[0].surface.vertices[0],
            (survey::WorldPoint{456333.922152, 7319649.059718, 2494.290327}));
}

// A model of several surfaces; what is no TSurf in it is told.
TEST(RealTsurf, AModelIsReadForItsSurfaces) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto read = gocad_tsurf::read(
      real_files() / "Geode-solutions+OpenGeode-GeosciencesIO/tests/geosciences/data/modelA1.ml");
  ASSERT_EQ(read.objects.size(), 9u);
  EXPECT_EQ(read.objects[0].surface.name, "h1_model1");
  EXPECT_EQ(read.objects[8].surface.name, "Top");
  const survey::Surface all = whole(read);
  EXPECT_EQ(all.vertices.size(), 5118u);
  EXPECT_EQ(all.triangles.size(), 7932u);
  ASSERT_EQ(read.report.rejected.size(), 1u);
  EXPECT_NE(read.report.rejected[0].reason.find("Model3d"), std::string::npos);
}

// The community fault model: everything that its table of facts states, of every surface in it.
TEST(RealTsurf, CommunityFaultModelHasTheFactsOfItsTable) {
  FOOTWALL_NEEDS_REAL_FILES();
  std::ifstream in(real_files() / "_derived/cfm_facts_open.csv");
  std::string line;
  std::getline(in, line);
  const auto names = text::split(line, ',');
  std::map<std::string, std::size_t, std::less<>> column;
  for (std::size_t n = 0; n < names.size(); ++n) column[std::string(names[n])] = n;
  int checked = 0;
  while (std::getline(in, line)) {
    const auto fields = text::split(line, ',');
    ASSERT_EQ(fields.size(), column.size());
    const auto stated = [&](const char* name) { return std::string(fields[column.at(name)]); };
    SCOPED_TRACE(stated("file"));
    const auto read = gocad_tsurf::read(real_files() / stated("file"));
    EXPECT_EQ(read.report.rejected_count, 0);
    ASSERT_EQ(read.objects.size(), 1u);
    survey::Surface surface = whole(read);
    const mesh::SurfaceFacts facts = mesh::surface_facts(surface);
    EXPECT_EQ(facts.vertices, std::stoll(stated("vertices")));
    EXPECT_EQ(facts.faces, std::stoll(stated("triangles")));
    EXPECT_EQ(facts.components, std::stoll(stated("components")));
    EXPECT_EQ(facts.boundary_loops, std::stoll(stated("boundary_loops")));
    EXPECT_EQ(facts.euler, std::stoll(stated("euler")));
    EXPECT_EQ(facts.nonmanifold_edges, std::stoll(stated("nonmanifold_edges")));
    EXPECT_EQ(facts.inconsistent_edges, std::stoll(stated("inconsistent_edges")));
    const double area = std::stod(stated("area_m2"));
    EXPECT_NEAR(facts.area, area, 1e-9 * area + 0.0005);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    survey::WorldPoint low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    for (survey::WorldPoint p : surface.vertices) {
      p.z = -p.z;  // the table has elevations
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_NEAR(low.x, std::stod(stated("xmin")), 0.000051);
    EXPECT_NEAR(low.y, std::stod(stated("ymin")), 0.000051);
    EXPECT_NEAR(low.z, std::stod(stated("zmin")), 0.000051);
    EXPECT_NEAR(high.x, std::stod(stated("xmax")), 0.000051);
    EXPECT_NEAR(high.y, std::stod(stated("ymax")), 0.000051);
    EXPECT_NEAR(high.z, std::stod(stated("zmax")), 0.000051);
    ++checked;
  }
  EXPECT_EQ(checked, 296);
}

}  // namespace
}  // namespace footwall::formats
