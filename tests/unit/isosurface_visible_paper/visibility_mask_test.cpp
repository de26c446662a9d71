#include "engine/isosurface/visible/paper/visibility_mask.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/verify/covered_by_definition.h"

namespace footwall::isosurface {
namespace {

TEST(VisibilityMask, DecidesAsThePrintedMaskDoes) {
  constexpr int kSize = 75;
  std::mt19937 random(1);
  const auto upto = [&](int last) { return std::uniform_int_distribution<int>(0, last)(random); };
  const auto rect = [&](int most) {
    const int x = upto(kSize + 4) - 4;
    const int y = upto(kSize + 4) - 4;
    return render::PixelRect{x, y, x + upto(most), y + upto(most)};
  };
  using Outcome = verify::CoveredPixels::Outcome;
  std::array<int, 3> seen{};
  for (int scene = 0; scene < 20; ++scene) {
    VisibilityMask mask(kSize, kSize);
    verify::CoveredPixels want(kSize, kSize);
    for (int pass = 0; pass < 6; ++pass) {
      for (int n = 0; n < 150; ++n) {
        const render::PixelRect box = rect(20);
        const Outcome outcome = want.classify(box.x0, box.y0, box.x1, box.y1);
        ++seen[static_cast<std::size_t>(outcome)];
        ASSERT_EQ(static_cast<int>(mask.classify(box)), static_cast<int>(outcome)) << "pass " << pass;
      }
      std::int64_t twos = 0;
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) twos += want.entry(x, y) == 2 ? 1 : 0;
      }
      EXPECT_EQ(mask.claimed_pixels(), twos);
      want.end_pass();
      render::CoverageMask covered(kSize, kSize);
      for (int n = 0; n < 8; ++n) {
        const render::PixelRect box = rect(30);
        covered.fill(box);
        want.fill(box.x0, box.y0, box.x1, box.y1);
      }
      mask.end_pass(covered);
    }
  }
  for (const int outcomes : seen) EXPECT_GT(outcomes, 100);
}

}  // namespace
}  // namespace footwall::isosurface
