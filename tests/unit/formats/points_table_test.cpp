#include "storage/formats/points_table.h"

#include <gtest/gtest.h>

#include "sample_mesh.h"
#include "scratch_folder.h"

namespace footwall::formats {
namespace {

TEST(PointsTable, OneRowAFaceAtItsCentroid) {
  const ScratchFolder folder;
  MeshTable small{"Big fault", {{0, 0, 30}, {3, 0, 60}, {0, 6, 90}}, {{0, 1, 2}}, {"1.0"}, {{"count", {12}}}};
  const auto renamed = points_table::write(folder / "p.txt", std::vector{small, sample_mesh("F1")}, true);
  EXPECT_EQ(renamed, (std::vector<std::string>{"Big fault -> Big_fault"}));
  const std::string text = content_of(folder / "p.txt");
  EXPECT_TRUE(
      text.starts_with("X Y Z fault face count mean variance\n"
                       "1.000000 2.000000 -60.000000 Big_fault 1.0 12 -99999 -99999\n"
                       "458177.791667 7322539.046224 -1643.655884 F1 p1:1 7 2 -99999\n"))
      << text;
  points_table::write(folder / "p.txt", std::vector{small}, false);
  EXPECT_NE(content_of(folder / "p.txt").find(" 60.000000 Big_fault"), std::string::npos);
}

}  // namespace
}  // namespace footwall::formats
