#include "storage/formats/vtp_surface.h"

#include <gtest/gtest.h>

#include "sample_triangles.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::vtp {
namespace {

// The bytes of an appended array, found by its name and offset.
std::string array_of(const std::string& bytes, const std::string& name) {
  const std::size_t data = bytes.find('_', bytes.find("<AppendedData encoding=\"raw\">")) + 1;
  const std::size_t tag = bytes.find("Name=\"" + name + "\"");
  EXPECT_NE(tag, std::string::npos) << name;
  const std::size_t at = data + std::stoul(bytes.substr(bytes.find("offset=\"", tag) + 8));
  return bytes.substr(at + 8, value_at<std::uint64_t>(bytes, at));
}

TEST(VtpSurface, ArraysStandWhereTheHeaderSays) {
  const ScratchFolder folder;
  for (const bool normals : {true, false}) {
    write_surface(folder / "f.vtp", sample_triangles(kManyTriangles, normals),
                  {"V<=3>", "m", "ms", "up", ""});
    const std::string bytes = content_of(folder / "f.vtp");
    EXPECT_NE(bytes.find("NumberOfPoints=\"131079\""), std::string::npos);
    EXPECT_NE(bytes.find("NumberOfPolys=\"131077\""), std::string::npos);
    EXPECT_TRUE(bytes.ends_with("</AppendedData>\n</VTKFile>\n"));
    EXPECT_EQ(array_of(bytes, "name"), std::string("V<=3>\0", 6));
    EXPECT_EQ(array_of(bytes, "z_positive"), std::string("up\0", 3));
    const std::string points = array_of(bytes, "Points");
    ASSERT_EQ(points.size(), 131079u * 24);
    EXPECT_EQ((value_at<std::array<double, 3>>(points, 24 * 131078)), sample_position(131078));
    const std::string corners = array_of(bytes, "connectivity"), offsets = array_of(bytes, "offsets");
    ASSERT_EQ(corners.size(), 131077u * 12);
    EXPECT_EQ((value_at<std::array<std::int32_t, 3>>(corners, 12 * 131076)),
              (std::array<std::int32_t, 3>{131076, 131077, 131078}));
    ASSERT_EQ(offsets.size(), 131077u * 4);
    EXPECT_EQ(value_at<std::int32_t>(offsets, 0), 3);
    EXPECT_EQ(value_at<std::int32_t>(offsets, 4 * 131076), 3 * 131077);
    EXPECT_EQ(bytes.find("Normals=\"Normals\"") != std::string::npos, normals);
    if (!normals) continue;
    EXPECT_EQ(value_at<float>(array_of(bytes, "Normals"), 12 * 70000 + 8), 70000);
  }
}

TEST(VtpSurface, NothingAtAllIsAFileToo) {
  const ScratchFolder folder;
  TriangleSource source = sample_triangles(0);
  source.vertices = 0;
  write_surface(folder / "f.vtp", source, {});
  EXPECT_TRUE(array_of(content_of(folder / "f.vtp"), "Points").empty());
}

}  // namespace
}  // namespace footwall::formats::vtp
