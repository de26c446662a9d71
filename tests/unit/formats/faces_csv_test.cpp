#include "storage/formats/faces_csv.h"

#include <gtest/gtest.h>

#include <sstream>

#include "sample_mesh.h"
#include "scratch_folder.h"

namespace footwall::formats::faces_csv {
namespace {

constexpr const char* kHead =
    "fault,face,x0,y0,z0,x1,y1,z1,x2,y2,z2,count,nulls,outside,mean,variance,min,max";

TEST(FacesCsv, ContractColumnsThenTheOthers) {
  MeshTable mesh = sample_mesh("Big \"B\", east");
  mesh.statistics.push_back({"offset", {1e-300, -0.5}});
  const ScratchFolder folder;
  write(folder / "f.csv", std::vector{mesh});
  EXPECT_EQ(content_of(folder / "f.csv"),
            std::string(kHead) + ",offset\n" +
                "\"Big \"\"B\"\", "
                "east\",p1:1,458177.125,7322538.712891,1643.655884,458178.125,7322538.712891,1643.655884,"
                "458178.125,7322539.712891,1643.655884,7,,,2,,,,1e-300\n"
                "\"Big \"\"B\"\", "
                "east\",p1:2,458177.125,7322538.712891,1643.655884,458178.125,7322539.712891,1643.655884,"
                "458177.125,7322539.712891,1643.655884,8,,,4,0.1,,,-0.5\n");
}

TEST(FacesCsv, AStatisticThatOneFaultLacksIsEmptyThere) {
  MeshTable second = sample_mesh("F2");
  second.statistics = {{"contrast", {0.5, 0.25}}};
  std::ostringstream out;
  print(out, std::vector{sample_mesh(), second});
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, std::string(kHead) + ",contrast");
  std::getline(lines, line);
  EXPECT_TRUE(line.ends_with(",7,,,2,,,,")) << line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_TRUE(line.ends_with(",,,,,,,,0.5")) << line;
}

TEST(FacesCsv, DeclaresItsUnitsInColumnsAtTheEnd) {
  const ScratchFolder folder;
  write(folder / "f.csv", std::vector{sample_mesh("F1")}, Declared{"ft", "ms", true, "EPSG:1, \"x\""});
  std::istringstream lines(content_of(folder / "f.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, std::string(kHead) + ",xy_unit,z_unit,z_positive,crs");
  std::getline(lines, line);
  EXPECT_TRUE(line.ends_with(",ft,ms,up,\"EPSG:1, \"\"x\"\"\"")) << line;
  EXPECT_NE(line.find("7322538.712891,-1643.655884,"), std::string::npos) << line;
}

TEST(FacesCsv, NoFaultsGiveTheHeadAlone) {
  std::ostringstream out;
  print(out, {});
  EXPECT_EQ(out.str(), std::string(kHead) + "\n");
}

}  // namespace
}  // namespace footwall::formats::faces_csv
