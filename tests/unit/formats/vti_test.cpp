#include "storage/formats/vti.h"

#include <gtest/gtest.h>

#include <cstring>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::vti {
namespace {

survey::Geometry sample_geometry() {
  survey::Geometry g;
  g.inlines = {10, 2, 3};
  g.crosslines = {100, 1, 4};
  g.samples = 5;
  g.z0 = 800;
  g.interval = 4;
  g.map = {1000.25, 2000.5, 3, 4, -8, 6};
  g.crs = "a <b> & \"c\"";
  return g;
}

void fill(const survey::Box& box, std::span<float> values) {
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
        values[n++] = static_cast<float>(100 * i + 10 * j + k);
    }
  }
}

std::string attribute(const std::string& text, const std::string& name) {
  const std::string mark = name + "=\"";
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t from = at + mark.size();
  return text.substr(from, text.find('"', from) - from);
}

TEST(Vti, PlacesSamplesInTheWorld) {
  const ScratchFolder folder;
  const survey::Geometry g = sample_geometry();
  for (const bool up : {true, false}) {
    write(folder / "a.vti", g, fill, {"far & near", up});
    const std::string bytes = content_of(folder / "a.vti");
    EXPECT_EQ(attribute(bytes, "WholeExtent"), "0 2 0 3 0 4");
    EXPECT_EQ(attribute(bytes, "Scalars"), "far &amp; near");
    double origin[3], spacing[3], d[9];
    ASSERT_EQ(std::sscanf(attribute(bytes, "Origin").c_str(), "%lf %lf %lf", origin, origin + 1, origin + 2),
              3);
    ASSERT_EQ(
        std::sscanf(attribute(bytes, "Spacing").c_str(), "%lf %lf %lf", spacing, spacing + 1, spacing + 2),
        3);
    ASSERT_EQ(std::sscanf(attribute(bytes, "Direction").c_str(), "%lf %lf %lf %lf %lf %lf %lf %lf %lf", d,
                          d + 1, d + 2, d + 3, d + 4, d + 5, d + 6, d + 7, d + 8),
              9);
    const double index[3] = {2, 3, 4};
    double world[3];
    for (int row = 0; row < 3; ++row) {
      world[row] = origin[row];
      for (int axis = 0; axis < 3; ++axis) world[row] += d[3 * row + axis] * spacing[axis] * index[axis];
    }
    const survey::WorldPoint want = g.world_of({2, 3, 4});
    EXPECT_NEAR(world[0], want.x, 1e-9);
    EXPECT_NEAR(world[1], want.y, 1e-9);
    EXPECT_NEAR(world[2], up ? -want.z : want.z, 1e-9);

    // The last array: its length, then samples with inlines fastest.
    const std::size_t mark = bytes.find("encoding=\"raw\">\n_") + 17;
    const std::size_t offset = std::stoul(bytes.substr(bytes.rfind("offset=\"", mark) + 8));
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + mark + offset, 8);
    ASSERT_EQ(length, 3u * 4 * 5 * 4);
    std::size_t at = mark + offset + 8;
    for (int k = 0; k < 5; ++k) {
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 3; ++i, at += 4) {
          float value = 0;
          std::memcpy(&value, bytes.data() + at, 4);
          ASSERT_EQ(value, static_cast<float>(100 * i + 10 * j + k));
        }
      }
    }
    EXPECT_EQ(bytes.substr(at), "\n</AppendedData>\n</VTKFile>\n");
    EXPECT_NE(bytes.find(std::string(up ? "up" : "down") + '\0'), std::string::npos);
  }
}

TEST(Vti, AFailedExportLeavesNoFile) {
  const ScratchFolder folder;
  EXPECT_THROW(
      write(folder / "a.vti", sample_geometry(),
            [](const survey::Box&, std::span<float>) { throw Error(ErrorCode::kCorrupt, "chunk"); }, {}),
      Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::formats::vti
