#include "storage/formats/gocad_tsurf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_mesh.h"
#include "sample_triangles.h"
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
      ASSERT_EQ(back.objects.size(), 2u);
      EXPECT_TRUE(back.report.assumed.empty());
      EXPECT_EQ(back.report.rejected_count, 0);
      EXPECT_EQ(back.objects[1].surface.name, "Big fault 2");
      EXPECT_EQ(back.objects[0].surface.triangles, meshes[0].triangles);
      EXPECT_EQ(back.objects[0].surface.vertices, meshes[0].vertices);
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
      "PROPERTIES SX SY\r\nPROPERTY_CLASS_HEADER SX {\r\nname:not this\r\n}\r\n"
      "TFACE\r\nPVRTX 0 1 2 -30 0.5 1\r\nPVRTX 7 4 5 -60 0.5 1 # x\r\nVRTX 20 7 9 -90\tCNXYZ \r\nTRGL 0 7 "
      "20\r\n"
      "TFACE\r\nATOM 21 7\r\nVRTX -4 1 1 -1\r\nTRGL 21 20 -4\r\n  TRGL 21 99 -4\r\nBSTONE 0\r\nBORDER 1 2 "
      "3\r\nEND\r\n"
      "GOCAD PLine 1\nHEADER {\nname:line\n}\nVRTX 1 0 0 0\nTRGL 1 1 1\nEND\n"
      "GOCAD TSurf 1\nHEADER {name:second}\nAXIS_UNIT \"m\" \"m\" \"feet\"\nZPOSITIVE Depth\nTFACE\nVRTX 1 0 "
      "0 5\n"
      "VRTX 2 1 0 5\nVRTX 3 0 1 5\nTRGL 1 2 3\nTRGL 1 1 3\nVRTX 3 9 9 9\nVRTX 4 1e400 0 0\nVRTX 5 1 2");
  ASSERT_EQ(read.objects.size(), 2u);
  const survey::Surface& first = read.objects[0].surface;
  EXPECT_EQ(first.name, "Fault one");
  ASSERT_EQ(first.vertices.size(), 5u);
  EXPECT_EQ(first.vertices[3], first.vertices[1]);  // the ATOM
  EXPECT_EQ(first.vertices[1], (survey::WorldPoint{4, 5, 60}));
  EXPECT_EQ(first.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {3, 2, 4}}));
  EXPECT_EQ(read.objects[0].properties, (std::vector<std::string>{"SX", "SY"}));
  EXPECT_EQ(read.objects[0].z_positive_up, std::nullopt);
  EXPECT_EQ(read.objects[0].vertical_unit, "");
  EXPECT_EQ(read.objects[1].surface.name, "second");
  EXPECT_EQ(read.objects[1].surface.vertices[0].z, 5);
  EXPECT_EQ(read.objects[1].surface.vertices.size(), 3u);
  EXPECT_EQ(read.objects[1].horizontal_unit, "m");
  EXPECT_EQ(read.objects[1].vertical_unit, "ft");
  EXPECT_EQ(read.objects[1].z_positive_up, false);
  EXPECT_EQ(read.report.assumed.size(), 2u);  // the first one's z, the second one's END
  EXPECT_EQ(read.report.read, 5 + 2 + 3 + 1);
  std::vector<std::string> places;
  for (const RejectedRow& row : read.report.rejected)
    places.push_back(std::to_string(row.line) + ":" + std::to_string(row.column));
  // A lost corner, the PLine, a corner named twice, an id that is taken, a number beyond doubles, a missing
  // z.
  EXPECT_EQ(places, (std::vector<std::string>{"19:11", "23:7", "39:6", "40:6", "41:8", "42:11"}));
  EXPECT_EQ(read.report.rejected_count, 6);
}

std::string with_line(const char* line) {
  std::string text = "GOCAD TSurf 1\n";
  text.append(line);
  text.append("VRTX 0 0 0 5\nVRTX 1 1 0 0\nVRTX 2 0 1 5\nTRGL 0 1 2\nEND");
  return text;
}

TEST(GocadTsurf, WhatIsToldOfZOverridesTheFile) {
  for (const char* stated : {"", "ZPOSITIVE Depth\n", "ZPOSITIVE ELEVATION\n"}) {
    EXPECT_EQ(parse(with_line(stated), false).objects[0].surface.vertices[0].z, 5);
    const ReadResult up = parse(with_line(stated), true);
    EXPECT_EQ(up.objects[0].surface.vertices[0].z, -5);
    EXPECT_FALSE(std::signbit(up.objects[0].surface.vertices[1].z));
    EXPECT_TRUE(up.report.assumed.empty());
  }
  EXPECT_EQ(parse(with_line("ZPOSITIVE Sideways\n")).report.rejected.size(), 1u);
}

TEST(GocadTsurf, HeadersEndWhereTheirBraceCloses) {
  for (const char* header :
       {"HEADER {name:F {1}}\n", "HEADER {\nname:F {1}\n}\n", "HEADER\n{\nname: F {1} }\n",
        "HEADER {\n*name:F {1}\nname2:x\n}\n", "HEADER { name:F {1}\n}\n"}) {
    EXPECT_EQ(parse(with_line(header)).objects.at(0).surface.name, "F {1}") << header;
  }
}

TEST(GocadTsurf, IdsMayBeAnything) {
  const ReadResult read = parse(
      "GOCAD TSurf 1\nZPOSITIVE Depth\nVRTX 9000000000000000000 1 0 0\nVRTX -9000000000000000000 2 0 0\nVRTX "
      "5000 3 0 0\n"
      "TFACE\nVRTX 5000 4 0 0\nTRGL 9000000000000000000 -9000000000000000000 5000\n"
      "TRGL 99999999999999999999 1 2\nATOM 7 8\nEND\n");
  ASSERT_EQ(read.objects.size(), 1u);
  EXPECT_EQ(read.objects[0].surface.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 3}}));
  EXPECT_EQ(read.report.rejected_count, 2);
}

TEST(GocadTsurf, NamesAndUnitsSurviveAndWhatCannotIsTold) {
  const ScratchFolder folder;
  for (const std::string unit : {"ms", "s", "m", "ft"}) {
    WriteOptions options;
    options.vertical_unit = unit;
    options.horizontal_unit = "ft";
    const auto renamed =
        write(folder / "f.ts", std::vector{sample_mesh("Störung {3} öst"), sample_mesh("断层 2")}, options);
    EXPECT_EQ(renamed, (std::vector<std::string>{"Störung {3} öst -> Störung (3) öst"}));
    std::string text;
    for (const char letter : content_of(folder / "f.ts")) {
      if (letter == '\n') text.push_back('\r');
      text.push_back(letter);
    }
    const ReadResult back = parse(text);
    ASSERT_EQ(back.objects.size(), 2u);
    EXPECT_EQ(back.objects[0].surface.name, "Störung (3) öst");
    EXPECT_EQ(back.objects[1].surface.name, "断层 2");
    EXPECT_EQ(back.objects[0].vertical_unit, unit);
    EXPECT_EQ(back.objects[0].horizontal_unit, "ft");
    EXPECT_EQ(back.objects[1].surface.vertices, sample_mesh().vertices);
    EXPECT_EQ(back.report.rejected_count, 0);
  }
}

TEST(GocadTsurf, RefusesWhatHasNoTriangles) {
  for (const char* text :
       {"", "x y z\n1 2 3\n", "GOCAD TSurf 1\nVRTX 1 1 1 1\nEND\n", "GOCAD TSurf 1\nTRGL 1 2 3\nEND\n",
        "GOCAD TSurf 1\nATOM 1 1\nATOM\nVRTX\nVRTX 1 nan 2 3\nTRGL 1\nTRGL 1 1 1\nEND",
        "GOCAD TSurf 1\nHEADER {\nVRTX 1 1 1 1\nTRGL 1 1 1"}) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kFormat);
    }
  }
  EXPECT_THROW(read("/no/such/file.ts"), Error);
}

// Whatever the bytes, the reader comes back or refuses.
TEST(GocadTsurf, SurvivesDamagedFiles) {
  const ScratchFolder folder;
  write(folder / "f.ts", std::vector{sample_mesh("F1"), sample_mesh("F2")});
  const std::string whole = content_of(folder / "f.ts");
  std::uint64_t state = 7;
  const auto random = [&] { return (state = state * 6364136223846793005ULL + 1442695040888963407ULL) >> 33; };
  int read_well = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (std::uint64_t n = random() % 4 + 1; n > 0; --n) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0) {
        text.erase(at, random() % 40);
      } else {
        text[at] = static_cast<char>(random());
      }
      if (text.empty()) text = "x";
    }
    try {
      for (const Object& object : parse(text).objects) {
        const auto vertices = static_cast<std::int32_t>(object.surface.vertices.size());
        for (const auto& corners : object.surface.triangles) {
          for (const std::int32_t corner : corners) ASSERT_TRUE(corner >= 0 && corner < vertices);
        }
      }
      ++read_well;
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ErrorCode::kFormat);
    }
  }
  EXPECT_GT(read_well, 1000);
}

TEST(GocadTsurf, ALargeSurfaceIsReadBack) {
  const ScratchFolder folder;
  write_surface(folder / "f.ts", sample_triangles(70000), {"iso {3}", "m", "ms", "down", ""});
  const ReadResult read_back = read(folder / "f.ts");
  ASSERT_EQ(read_back.objects.size(), 1u);
  const Object& object = read_back.objects.front();
  EXPECT_EQ(object.surface.vertices.size(), 70002u);
  ASSERT_EQ(object.surface.triangles.size(), 70000u);
  EXPECT_EQ(object.surface.triangles.back(), (std::array<std::int32_t, 3>{69999, 70000, 70001}));
  EXPECT_NEAR(object.surface.vertices[70001].x, sample_position(70001)[0], 1e-6);
  EXPECT_EQ(object.z_positive_up, std::optional<bool>(false));
  EXPECT_EQ(object.vertical_unit, "ms");
}

}  // namespace
}  // namespace footwall::formats::gocad_tsurf
