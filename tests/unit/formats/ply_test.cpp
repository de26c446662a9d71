#include "storage/formats/ply.h"

#include <gtest/gtest.h>

#include "sample_triangles.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::ply {
namespace {

TEST(Ply, HoldsWhatTheHeaderSays) {
  const ScratchFolder folder;
  for (const bool normals : {true, false}) {
    write(folder / "f.ply", sample_triangles(kManyTriangles, normals),
          {"a\nb", "m", "ms", "up", "EPSG:23031"});
    const std::string bytes = content_of(folder / "f.ply");
    const std::size_t data = bytes.find("end_header\n") + 11;
    const std::string header = bytes.substr(0, data);
    EXPECT_EQ(header.substr(0, 41), "ply\nformat binary_little_endian 1.0\ncomme");
    EXPECT_NE(header.find("comment name a b\n"), std::string::npos);
    EXPECT_NE(header.find("comment crs EPSG:23031\n"), std::string::npos);
    EXPECT_NE(header.find("element vertex 131079\nproperty double x\n"), std::string::npos);
    EXPECT_NE(header.find("element face 131077\nproperty list uchar uint vertex_indices\n"),
              std::string::npos);
    EXPECT_EQ(header.find("property float nx") != std::string::npos, normals);
    const std::size_t vertex = normals ? 36 : 24;
    ASSERT_EQ(bytes.size(), data + 131079 * vertex + 131077 * 13);
    for (const std::uint64_t n : {std::uint64_t{0}, std::uint64_t{70000}, std::uint64_t{131078}}) {
      EXPECT_EQ((value_at<std::array<double, 3>>(bytes, data + n * vertex)), sample_position(n));
      if (!normals) continue;
      EXPECT_EQ(value_at<float>(bytes, data + n * vertex + 32), static_cast<float>(n));
    }
    const std::size_t last = data + 131079 * vertex + 131076 * 13;
    EXPECT_EQ(bytes[last], 3);
    EXPECT_EQ((value_at<std::array<std::uint32_t, 3>>(bytes, last + 1)),
              (std::array<std::uint32_t, 3>{131076, 131077, 131078}));
  }
}

TEST(Ply, AFailureLeavesNoFile) {
  const ScratchFolder folder;
  TriangleSource source = sample_triangles(10);
  source.corners = [](auto, auto) { throw Error(ErrorCode::kCancelled, "cancelled"); };
  EXPECT_THROW(write(folder / "f.ply", source, {}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  write(folder / "f.ply", sample_triangles(0), {});
  EXPECT_TRUE(std::filesystem::exists(folder / "f.ply"));
}

}  // namespace
}  // namespace footwall::formats::ply
