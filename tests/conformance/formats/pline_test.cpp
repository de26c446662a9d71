#include "storage/formats/pline.h"

#include <sstream>

#include "real_files.h"
#include "storage/base/error.h"
#include "storage/formats/stick_formats.h"

namespace footwall::formats {
namespace {

TEST(RealPLine, EachOfManyClosedLinesIsAStickInTheOrderOfItsSegments) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto path = real_files() / "Geode-solutions+OpenGeode-GeosciencesIO/tests/data/closed_lines.pl";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no test data in " << path;
  const SticksImport read = read_sticks(path, "", {});
  EXPECT_EQ(read.format, "pline");
  EXPECT_EQ(read.report.rejected_count, 0);

  // Counted apart: the file has its vertices in the order of the lines, and each line's last segment leads
  // back to its first vertex.
  std::ifstream in(path);
  std::vector<std::vector<survey::WorldPoint>> lines;
  for (std::string row; std::getline(in, row);) {
    std::istringstream words(row);
    std::string word;
    double id = 0, x = 0, y = 0, z = 0;
    words >> word;
    if (word == "ILINE") lines.emplace_back();
    if (word == "VRTX" && words >> id >> x >> y >> z) lines.back().push_back({x, y, -z});
  }
  ASSERT_EQ(read.sticks.size(), lines.size());
  std::int64_t points = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    lines[n].push_back(lines[n].front());
    EXPECT_EQ(read.sticks[n].points, lines[n]) << "line " << n;
    EXPECT_EQ(read.sticks[n].fault, "xs+ls-ore-25");
    points += static_cast<std::int64_t>(lines[n].size());
  }
  EXPECT_EQ(read.report.read, points);
  EXPECT_EQ(lines.size(), 74u);
  EXPECT_EQ(points, 9395 + 74);
}

TEST(RealPLine, SurfacesAreRefusedByName) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto path = real_files() / "equinor+xtgeo-testdata/surfaces/drogon/3/F5.ts";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no test data in " << path;
  try {
    read_sticks(path, "", {});
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("TSurf"), std::string::npos);
    EXPECT_NE(error.hint().find("import surface"), std::string::npos);
  }
}

}  // namespace
}  // namespace footwall::formats
