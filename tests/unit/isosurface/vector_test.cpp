#include "engine/isosurface/vector.h"

#include "engine/isosurface/detail/half_table.h"
#include "engine/voxelize/simd.h"
#include "variant_check.h"

namespace footwall::isosurface {
namespace {

TEST(Vector, GivesTheSurfaceOfTheDefinitionOnEveryInstructionSet) {
  for (const auto level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    voxelize::limit_simd(level);
    check_random_volumes(extract_vector);
    check_odd_values(extract_vector);
  }
  voxelize::limit_simd(forced_simd());
}

TEST(Vector, OfAPartIsThatOfTheWhole) {
  check_parts(extract_vector);
}

TEST(Vector, GivesWhatIsAskedFor) {
  check_choices(extract_vector);
}

TEST(HalfTable, HoldsEveryPattern) {
  const detail::HalfTable table;
  int entries = 0;
  for (unsigned signs = 0; signs < 256; ++signs) {
    for (unsigned bits = 0; bits < 256; ++bits) {
      const auto alternative = static_cast<Alternative>(bits);
      if (!has_pattern(signs, alternative)) continue;
      ++entries;
      const Pattern& pattern = pattern_of(signs, alternative);
      const auto entry = table.entry(signs, alternative);
      EXPECT_EQ(entry.has_centre, pattern.has_centre);
      EXPECT_EQ(entry.centre_edges, pattern.centre_edges);
      std::vector<std::array<std::uint8_t, 3>> triangles;
      entry.for_each_triangle([&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
        triangles.push_back({a, b, c});
      });
      EXPECT_EQ(triangles, std::vector(pattern.triangles.begin(), pattern.triangles.end()))
          << "signs " << signs << ", alternative " << bits;
    }
  }
  EXPECT_GT(entries, 256);
}

}  // namespace
}  // namespace footwall::isosurface
