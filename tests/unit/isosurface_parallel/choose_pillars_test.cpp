#include "engine/isosurface/parallel/choose_pillars.h"

#include <gtest/gtest.h>

#include "unit/isosurface_parallel/sample_pyramid.h"

namespace footwall::isosurface {
namespace {

const survey::Index kVolume{129, 129, 65};

Pyramid even_pyramid() {
  return {{16, 16, 8}, [](const survey::Index&) { return true; }};
}
// All active bricks in the middle of the volume.
Pyramid crowded_pyramid() {
  return {{16, 16, 8},
          [](const survey::Index& at) { return at[0] >= 4 && at[0] < 7 && at[1] >= 3 && at[1] < 6; }};
}

TEST(ChoosePillars, EvenWorkIsNotCutUp) {
  const Pyramid even = even_pyramid();
  EXPECT_EQ(choose_interleaving(kVolume, 4, even.bricks, 0, true), (Interleaving{1, 1, 1}));
  EXPECT_EQ(choose_interleaving(kVolume, 1, even.bricks, 0, true), (Interleaving{1, 1, 1}));
}

TEST(ChoosePillars, CrowdedWorkIsSharedByAllRanks) {
  const Pyramid crowded = crowded_pyramid();
  const WorkForecast plain = forecast(Pillars(kVolume, 4, {1, 1, 1}), crowded.bricks, 0, true);
  EXPECT_GT(plain.slowest, 3.9 * plain.mean);  // one rank has it all
  const Interleaving chosen = choose_interleaving(kVolume, 4, crowded.bricks, 0, true);
  const WorkForecast shared = forecast(Pillars(kVolume, 4, chosen), crowded.bricks, 0, true);
  EXPECT_LT(shared.slowest, plain.slowest / 2);
  EXPECT_GT(shared.redundant, plain.redundant);
}

TEST(ChoosePillars, VolumesWithoutCellsNeedNone) {
  const Pyramid even = even_pyramid();
  EXPECT_EQ(choose_interleaving({1, 129, 65}, 4, even.bricks, 0, true), (Interleaving{1, 1, 1}));
}

}  // namespace
}  // namespace footwall::isosurface
