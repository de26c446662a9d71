#include "engine/isosurface/parallel/choose_pillars.h"

#include <gtest/gtest.h>

namespace footwall::isosurface {
namespace {

// All active bricks in the middle of the volume, or everywhere.
struct Pyramid {
  std::vector<float> min, max;
  std::vector<std::uint8_t> has_null;
  Bricks bricks;
  survey::Index volume{129, 129, 65};

  explicit Pyramid(bool everywhere) {
    bricks.dims = {16, 16, 8};
    for (std::int64_t a = 0; a < 16; ++a) {
      for (std::int64_t b = 0; b < 16; ++b) {
        for (std::int64_t c = 0; c < 8; ++c) {
          const bool active = everywhere || (a >= 4 && a < 7 && b >= 3 && b < 6);
          min.push_back(active ? -1 : 1);
          max.push_back(2);
          has_null.push_back(0);
        }
      }
    }
    bricks.min = min;
    bricks.max = max;
    bricks.has_null = has_null;
  }
};

TEST(ChoosePillars, EvenWorkIsNotCutUp) {
  const Pyramid even(true);
  EXPECT_EQ(choose_interleaving(even.volume, 4, even.bricks, 0, true), (Interleaving{1, 1, 1}));
  EXPECT_EQ(choose_interleaving(even.volume, 1, even.bricks, 0, true), (Interleaving{1, 1, 1}));
}

TEST(ChoosePillars, CrowdedWorkIsSharedByAllRanks) {
  const Pyramid crowded(false);
  const WorkForecast plain = forecast(Pillars(crowded.volume, 4, {1, 1, 1}), crowded.bricks, 0, true);
  EXPECT_GT(plain.slowest, 3.9 * plain.mean);  // one rank has it all
  const Interleaving chosen = choose_interleaving(crowded.volume, 4, crowded.bricks, 0, true);
  const WorkForecast shared = forecast(Pillars(crowded.volume, 4, chosen), crowded.bricks, 0, true);
  EXPECT_LT(shared.slowest, plain.slowest / 2);
  EXPECT_GT(shared.redundant, plain.redundant);
}

TEST(ChoosePillars, VolumesWithoutCellsNeedNone) {
  const Pyramid even(true);
  EXPECT_EQ(choose_interleaving({1, 129, 65}, 4, even.bricks, 0, true), (Interleaving{1, 1, 1}));
}

}  // namespace
}  // namespace footwall::isosurface
