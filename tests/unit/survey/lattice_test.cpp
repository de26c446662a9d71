#include "storage/survey/lattice.h"

#include <gtest/gtest.h>

#include <limits>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

TEST(Lattice, RoundsOnceTiesToEven) {
  const Lattice lattice{Geometry{}};
  const LatticePoint p = lattice.from_index({0.5 / 256, 1.5 / 256, -0.5 / 256});
  EXPECT_EQ(p, (LatticePoint{0, 2, 0}));
  EXPECT_EQ(Lattice::index_of(LatticePoint{128, -256, 1}), (IndexPoint{0.5, -1, 1.0 / 256}));
}

TEST(Lattice, RefusesPositionsBeyondItsReach) {
  const Lattice lattice{Geometry{}};
  EXPECT_NO_THROW(lattice.from_index({8388607, 0, 0}));
  EXPECT_THROW(lattice.from_index({8388608, 0, 0}), Error);
  EXPECT_THROW(lattice.from_index({0, std::numeric_limits<double>::quiet_NaN(), 0}), Error);
  EXPECT_THROW(lattice.from_index({0, 0, -std::numeric_limits<double>::infinity()}), Error);
}

}  // namespace
}  // namespace footwall::survey
