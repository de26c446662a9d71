#include "storage/survey/moved_lattice.h"

#include <gtest/gtest.h>

#include <limits>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

TEST(MovedLattice, GoesToAVolumeAndBack) {
  const LatticeTriangle there{{{256, 300, -1}, {0, 1, 2}, {-512, 1000000, 7}}};
  const Index origin{3, 0, 10};
  const LatticeTriangle here = in_volume(there, origin);
  EXPECT_EQ(here[0], (LatticePoint{-512, 300, -2561}));
  EXPECT_EQ(in_survey(here, origin), there);
  EXPECT_EQ(in_volume(there, {0, 0, 0}), there);
}

TEST(MovedLattice, RefusesWhatIsOutOfReach) {
  const LatticePoint last{std::numeric_limits<std::int32_t>::max(), 0, 0};
  EXPECT_NO_THROW(moved(last, {-1, 0, 0}));
  EXPECT_EQ(moved(last, {0, 0, 0}), last);
  EXPECT_THROW(moved(last, {1, 0, 0}), Error);
  EXPECT_THROW(moved({0, 0, 0}, {0, -(1 << 23), 0}), Error);
  EXPECT_NO_THROW(moved({0, 256, 0}, {0, -(1 << 23), 0}));
  EXPECT_THROW(moved({0, 0, 0}, {0, 0, std::numeric_limits<std::int64_t>::max()}), Error);
  EXPECT_THROW(moved({0, 0, 0}, {0, 0, std::numeric_limits<std::int64_t>::min() + 1}), Error);
}

}  // namespace
}  // namespace footwall::survey
