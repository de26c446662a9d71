// GOCAD TSurf: whatever is read must be a surface whose triangles name vertices that are there.
#include "fuzz/target.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::fuzz {
namespace {

bool run(const std::string& bytes) {
  const auto read = formats::gocad_tsurf::parse(bytes);
  for (const formats::gocad_tsurf::Object& object : read.objects) {
    const survey::Surface& surface = object.surface;
    for (const survey::WorldPoint& point : surface.vertices) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return false;
    }
    for (const auto& triangle : surface.triangles) {
      for (const std::int32_t vertex : triangle) {
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= surface.vertices.size()) return false;
      }
    }
  }
  return true;
}

constexpr const char* kSmall =
    "GOCAD TSurf 1\nHEADER {\nname:F1\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n"
    "AXIS_UNIT \"m\" \"m\" \"m\"\nZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nPROPERTIES v\n"
    "NO_DATA_VALUES -99999\nESIZES 1\nTFACE\nPVRTX 1 0 0 -10 1\nPVRTX 2 10 0 -10 2\nVRTX 3 0 10 -20\nATOM 4 "
    "2\n"
    "TRGL 1 2 3\nTFACE\nVRTX 5 20 0 -10\nTRGL 4 5 3\nBSTONE 1\nBORDER 8 1 4\nEND\n";

}  // namespace

Target fuzz_target() {
  return {{"Geode-solutions+OpenGeode-GeosciencesIO/tests/data/*.ts",
           "equinor+xtgeo-testdata/surfaces/drogon/3/F5.ts",
           "OPM+ResInsight/ApplicationLibCode/UnitTests/TestData/RifSurfaceImporter/tsurf_eks.ts",
           "SCECcode+CFM_web/schema/CFM5.3_latest/obj/alt/*.ts"},
          {kSmall},
          run};
}

}  // namespace footwall::fuzz
