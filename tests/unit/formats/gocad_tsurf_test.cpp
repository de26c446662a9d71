#include "storage/formats/gocad_tsurf.h"

#include <gtest/gtest.h>

#include "sample_mesh.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::gocad_tsurf {
namespace {

TEST(GocadTsurf, WhatIsWrittenReadsBackTheSame) {
  const ScratchFolder folder;
  const std::vector meshes{sample_mesh("F1"), sample_mesh("Big fault 2")};
  for (const bool up : {false, true}) {
    for (const bool strict : {false, true}) {
      WriteOptions options;
      options.z_positive_up = up;
      options.strict = strict;
      if (!strict) options.properties = {"mean"};
      write(folder / "f.ts", meshes, options);
      const ReadResult back = read(folder / "f.ts");
      ASSERT_EQ(back.surfaces.size(), 2u);
      EXPECT_TRUE(back.report.assumed.empty());
      EXPECT_TRUE(back.report.warnings.empty());
      EXPECT_EQ(back.surfaces[1].name, "Big fault 2");
      EXPECT_EQ(back.surfaces[0].triangles, meshes[0].triangles);
      for (std::size_t n = 0; n < meshes[0].vertices.size(); ++n) {
        EXPECT_EQ(back.surfaces[0].vertices[n], meshes[0].vertices[n]);
      }
    }
  }
}

TEST(GocadTsurf, PropertiesAreAreaWeightedMeansWithNoData) {
  const ScratchFolder folder;
  MeshTable mesh = sample_mesh();
  mesh.statistics[1].values[1] = 0.25;
  mesh.vertices[3].x -= 2;  // the second triangle is three times as large now
  WriteOptions options;
  options.properties = {"mean", "variance"};
  write(folder / "f.ts", std::vector{mesh}, options);
  const std::string text = content_of(folder / "f.ts");
  EXPECT_NE(text.find("PROPERTIES mean variance\nNO_DATA_VALUES -99999 -99999\nESIZES 1 1\n"),
            std::string::npos);
  EXPECT_NE(text.find("\nPVRTX 1 458177.125000 7322538.712891 1643.655884 3.5 0.25\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nPVRTX 2 458178.125000 7322538.712891 1643.655884 2 -99999\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nPVRTX 5 0.100000 2.000000 3.000000 -99999 -99999\n"), std::string::npos) << text;
  EXPECT_NE(text.find("ZPOSITIVE Depth"), std::string::npos);
}

TEST(GocadTsurf, StrictFormIsNarrow) {
  const ScratchFolder folder;
  WriteOptions options;
  options.strict = true;
  write(folder / "f.ts", std::vector{sample_mesh()}, options);
  const std::string text = content_of(folder / "f.ts");
  EXPECT_EQ(text.find("GEOLOGICAL"), std::string::npos);
  EXPECT_NE(text.find("VRTX 1 458177.125000 7322538.712891 1643.655884 CNXYZ\n"), std::string::npos);
  options.properties = {"mean"};
  EXPECT_THROW(write(folder / "g.ts", std::vector{sample_mesh()}, options), Error);
  options.strict = false;
  options.properties = {"no such"};
  EXPECT_THROW(write(folder / "g.ts", std::vector{sample_mesh()}, options), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "g.ts"));
}

TEST(GocadTsurf, TakesTheOdditiesOfRealFiles) {
  const ReadResult read = parse(
      "GOCAD TSurf 1 \r\nHEADER { \r\n*solid*color:1 0 0 1\r\n name: Fault one \r\n} \r\n"
      "PROPERTIES SX\r\nPROPERTY_CLASS_HEADER SX {\r\nname:not this\r\n}\r\n"
      "TFACE\r\nPVRTX 0 1 2 -30 0.5\r\nPVRTX 7 4 5 -60 0.5 # x\r\nVRTX 20 7 9 -90\r\nTRGL 0 7 20\r\n"
      "TFACE\r\nATOM 21 7\r\nVRTX 22 1 1 -1\r\nTRGL 21 20 22\r\nTRGL 21 99 22\r\nBSTONE 0\r\nBORDER 1 2 "
      "3\r\nEND\r\n"
      "GOCAD PLine 1\nHEADER {\nname:line\n}\nVRTX 1 0 0 0\nTRGL 1 1 1\nEND\n"
      "GOCAD TSurf 1\nHEADER {name:second}\nZPOSITIVE Depth\nTFACE\nVRTX 1 0 0 5\nVRTX 2 1 0 5\nVRTX 3 0 1 "
      "5\nTRGL 1 2 3\n");
  ASSERT_EQ(read.surfaces.size(), 2u);
  const survey::Surface& first = read.surfaces[0];
  EXPECT_EQ(first.name, "Fault one");
  ASSERT_EQ(first.vertices.size(), 5u);
  EXPECT_EQ(first.vertices[3], first.vertices[1]);  // the ATOM
  EXPECT_EQ(first.vertices[1], (survey::WorldPoint{4, 5, 60}));
  EXPECT_EQ(first.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {3, 2, 4}}));
  EXPECT_EQ(read.surfaces[1].name, "second");
  EXPECT_EQ(read.surfaces[1].vertices[0].z, 5);
  EXPECT_EQ(read.report.assumed.size(), 1u);   // the first one's z
  EXPECT_EQ(read.report.warnings.size(), 3u);  // a lost triangle, a PLine, no END
}

TEST(GocadTsurf, RefusesWhatHasNoTriangles) {
  for (const char* text :
       {"", "x y z\n1 2 3\n", "GOCAD TSurf 1\nVRTX 1 1 1 1\nEND\n", "GOCAD TSurf 1\nTRGL 1 2 3\nEND\n",
        "GOCAD TSurf 1\nATOM 1 1\nATOM\nVRTX\nVRTX 1 nan 2 3\nTRGL 1\nTRGL 1 1 1\nEND"}) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kFormat);
    }
  }
  EXPECT_THROW(read("/no/such/file.ts"), Error);
}

}  // namespace
}  // namespace footwall::formats::gocad_tsurf
