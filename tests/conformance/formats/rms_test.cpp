#include "storage/formats/rms.h"

#include "real_files.h"
#include "storage/formats/stick_formats.h"
#include "storage/formats/zmap.h"

namespace footwall::formats {
namespace {

// The lines of the CSV file beside the polygons: the same positions, with a line's number in a column.
std::vector<std::vector<survey::WorldPoint>> lines_of_csv(const std::filesystem::path& path) {
  std::vector<std::vector<survey::WorldPoint>> lines;
  std::ifstream in(path);
  std::string last;
  for (std::string row; std::getline(in, row);) {
    const auto fields = text::split(row, ',');
    const auto x = text::number(fields[0]);
    if (fields.size() < 4 || !x) continue;
    if (lines.empty() || fields[3] != last) lines.emplace_back();
    last = fields[3];
    lines.back().push_back({*x, *text::number(fields[1]), *text::number(fields[2])});
  }
  return lines;
}

TEST(RealRms, PolygonsHaveTheLinesOfTheCsvFileBesideThem) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder = real_files() / "equinor+xtgeo-testdata/polygons/reek/1";
  const auto csv = folder / "top_upper_reek_faultpoly.csv";
  if (!std::filesystem::exists(csv)) GTEST_SKIP() << "skipped: no test data in " << csv;
  const auto lines = lines_of_csv(csv);
  ASSERT_GT(lines.size(), 1u);
  for (const std::string name : {"top_upper_reek_faultpoly.pol", "top_upper_reek_faultpoly.xyz"}) {
    const SticksImport read = read_sticks(folder / name, "", {});
    EXPECT_EQ(read.format, "rms");
    EXPECT_EQ(read.report.rejected_count, 0);
    ASSERT_EQ(read.sticks.size(), lines.size()) << name;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      EXPECT_EQ(read.sticks[n].fault, "top_upper_reek_faultpoly");
      ASSERT_EQ(read.sticks[n].points.size(), lines[n].size()) << "line " << n;
      for (std::size_t k = 0; k < lines[n].size(); ++k) {
        EXPECT_NEAR(read.sticks[n].points[k].x, lines[n][k].x, 1e-6);
        EXPECT_NEAR(read.sticks[n].points[k].y, lines[n][k].y, 1e-6);
        EXPECT_NEAR(read.sticks[n].points[k].z, lines[n][k].z, 1e-6);
      }
    }
  }
}

TEST(RealRms, TheirLinesGoThroughZmapAndBack) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto path = real_files() / "equinor+xtgeo-testdata/polygons/reek/1/top_upper_reek_faultpoly.pol";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no test data in " << path;
  const SticksImport read = read_sticks(path, "", {});
  std::vector<std::string> renamed;
  const SticksImport again = zmap::parse(zmap::write(read.sticks, {}, renamed), {});
  ASSERT_EQ(again.sticks.size(), read.sticks.size());
  for (std::size_t n = 0; n < read.sticks.size(); ++n) {
    EXPECT_EQ(again.sticks[n].points, read.sticks[n].points);  // six decimals in both
  }
}

}  // namespace
}  // namespace footwall::formats
