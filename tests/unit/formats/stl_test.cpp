#include "storage/formats/stl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_triangles.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::stl {
namespace {

TEST(Stl, FacetsHaveTheirCornersAndTheNormalOfTheirWinding) {
  const ScratchFolder folder;
  TriangleSource source = sample_triangles(kManyTriangles);
  // Small numbers, so that floats hold them; in the plane z = 2, counter-clockwise from above.
  source.positions = [](std::uint64_t first, std::span<std::array<double, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) {
      const auto at = static_cast<double>(first + n);
      into[n] = {at, at * at, 2};
    }
  };
  write(folder / "f.stl", source, {"solid", "m", "ms", "up", ""});
  const std::string bytes = content_of(folder / "f.stl");
  ASSERT_EQ(bytes.size(), 84 + 50 * kManyTriangles);
  // Readers take a file that begins with "solid" for the text form.
  EXPECT_EQ(bytes.substr(0, 14), "Footwall solid");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, 80), kManyTriangles);
  for (const std::size_t n : {std::size_t{0}, std::size_t{1000}}) {
    const auto facet = value_at<std::array<float, 12>>(bytes, 84 + 50 * n);
    const auto x = static_cast<float>(n);
    EXPECT_EQ(facet, (std::array<float, 12>{0, 0, 1, x, x * x, 2, x + 1, (x + 1) * (x + 1), 2, x + 2,
                                            (x + 2) * (x + 2), 2}));
    EXPECT_EQ(value_at<std::uint16_t>(bytes, 84 + 50 * n + 48), 0);
  }
}

TEST(Stl, AVertexThatIsNotThereIsABug) {
  const ScratchFolder folder;
  TriangleSource source = sample_triangles(4);
  source.vertices = 5;
  EXPECT_THROW(write(folder / "f.stl", source, {}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  source.triangles = std::uint64_t{1} << 32;
  EXPECT_THROW(write(folder / "f.stl", source, {}), Error);
}

}  // namespace
}  // namespace footwall::formats::stl
