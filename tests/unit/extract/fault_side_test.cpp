#include "engine/extract/fault_side.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace footwall::extract {
namespace {

using survey::LatticeTriangle;

// Its normal points along i.
constexpr LatticeTriangle kAcross{{{0, 0, 0}, {0, 256, 0}, {0, 0, 256}}};

LatticeTriangle turned(LatticeTriangle triangle) {
  std::swap(triangle[1], triangle[2]);
  return triangle;
}

int side_of_all(const std::vector<LatticeTriangle>& faces) {
  return fault_side(faces);
}

TEST(FaultSide, FollowsTheMeanNormalsFirstComponent) {
  EXPECT_EQ(side_of_all({kAcross}), 1);
  EXPECT_EQ(side_of_all({turned(kAcross)}), -1);
  // Weighted by area: the larger one decides.
  LatticeTriangle large = turned(kAcross);
  large[1].k = 1024;
  EXPECT_EQ(side_of_all({kAcross, large}), -1);
  // Without a component along i that of j decides, then k.
  const LatticeTriangle along{{{0, 0, 0}, {256, 0, 0}, {0, 0, 256}}};
  EXPECT_EQ(side_of_all({along}), -1);
  EXPECT_EQ(side_of_all({turned(along)}), 1);
}

TEST(FaultSide, IsThatOfTheWindingsWhereTheSumIsZero) {
  EXPECT_EQ(side_of_all({kAcross, turned(kAcross)}), 1);
  EXPECT_EQ(side_of_all({}), 1);
}

TEST(FaultSide, IsExactWhereDoublesAreNot) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  const LatticeTriangle huge{{{0, 0, 0}, {0, kFar, 0}, {0, 0, kFar}}};
  // One unit in 2^62 more on the other side.
  LatticeTriangle other = turned(huge);
  const LatticeTriangle least{{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  EXPECT_EQ(side_of_all({huge, other}), 1);
  EXPECT_EQ(side_of_all({huge, other, least}), -1);
}

}  // namespace
}  // namespace footwall::extract
