#include "engine/voxelize/exact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/simd.h"
#include "rounds.h"
#include "unit/voxelize/triangles.h"

namespace footwall::voxelize {
namespace {

using survey::Box;
using survey::Index;
using survey::LatticeTriangle;

constexpr std::int32_t kFarthest = std::numeric_limits<std::int32_t>::max() - 127;
constexpr Box kEverywhere = {{-(1 << 25), -(1 << 25), -(1 << 25)}, {1 << 25, 1 << 25, 1 << 25}};

std::vector<Index> sorted(std::vector<Index> voxels) {
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

class Exact : public ::testing::Test {
 protected:
  void TearDown() override { limit_simd(forced_simd()); }
  void expect_definition(const LatticeTriangle& t, const Box& box) {
    ASSERT_EQ(sorted(list(t, box, scratch_)), verify::voxels_by_definition(t, box)) << text_of(t);
  }
  ExactScratch scratch_;
};

TEST_F(Exact, EqualsTheDefinitionForEveryKindOfTriangle) {
  Numbers numbers(1);
  for (int round = 0; round < rounds(600); ++round) {
    for (const Kind kind : kAllKinds) {
      const std::int32_t extent = 256 * numbers.within(1, 7);
      const auto t = make_triangle(kind, extent, {numbers.within(-9999, 9999), 0, -77}, numbers);
      expect_definition(t, survey::grown(bounding_voxels(t), 1));
    }
  }
}

TEST_F(Exact, EqualsTheDefinitionWithEveryInstructionSet) {
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    limit_simd(level);
    Numbers numbers(2);
    for (int round = 0; round < 60; ++round) {
      for (const Kind kind : kAllKinds) {
        const auto t = make_triangle(kind, 2500, {5, 6, 7}, numbers);
        expect_definition(t, survey::grown(bounding_voxels(t), 1));
      }
    }
  }
}

TEST_F(Exact, IsRightAtTheEndsOfTheLattice) {
  Numbers numbers(3);
  for (int round = 0; round < 60; ++round) {
    for (const Kind kind : kAllKinds) {
      const std::int32_t far = kFarthest - 1500;
      const auto end = [&] { return numbers.next() % 2 == 0 ? far : -far; };
      const auto t = make_triangle(kind, 1500, {end(), end(), end()}, numbers);
      expect_definition(t, survey::grown(bounding_voxels(t), 1));
    }
  }
  const std::int32_t least = std::numeric_limits<std::int32_t>::min();
  const std::int32_t most = std::numeric_limits<std::int32_t>::max();
  const LatticeTriangle lowest = {
      {{least, least, least}, {least + 300, least, least}, {least, least + 900, least + 5}}};
  expect_definition(lowest, survey::grown(bounding_voxels(lowest), 1));
  const LatticeTriangle highest = {
      {{most, most, most}, {most - 300, most, most}, {most, most - 900, most - 5}}};
  expect_definition(highest, survey::grown(bounding_voxels(highest), 1));
}

// Triangles that span the lattice need 128 bits; only the columns of the box are looked at. The boxes lie on
// the triangle, so that they hold some of its voxels.
TEST_F(Exact, HugeTrianglesAreExactInsideASmallBox) {
  Numbers numbers(4);
  std::size_t found = 0;
  for (int round = 0; round < 400; ++round) {
    const int bits = numbers.within(12, 31);
    const auto reach = static_cast<std::int32_t>((std::int64_t{1} << bits) - 1);
    const Kind kind = kAllKinds[numbers.next() % 8];
    if (kind == Kind::kPoint) continue;
    auto t = make_triangle(Kind::kAny, reach, {0, 0, 0}, numbers);
    if (kind == Kind::kSliver)
      t[2] = {t[1].i / 2 + t[0].i / 2, t[1].j / 2 + t[0].j / 2, t[1].k / 2 + t[0].k / 2};
    if (kind == Kind::kAxisAligned) t[0].j = t[1].j = t[2].j;
    const double a = numbers.within(0, 1000) / 1000.0;
    const double b = (1 - a) * numbers.within(0, 1000) / 1000.0;
    const auto inside = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
      return static_cast<std::int64_t>((a * p + b * q + (1 - a - b) * r) / 256);
    };
    const Index centre = {inside(t[0].i, t[1].i, t[2].i), inside(t[0].j, t[1].j, t[2].j),
                          inside(t[0].k, t[1].k, t[2].k)};
    const Box box = survey::grown({centre, {centre[0] + 1, centre[1] + 1, centre[2] + 1}}, 5);
    const auto expected = verify::voxels_by_definition(t, box);
    found += expected.size();
    ASSERT_EQ(sorted(list(t, box, scratch_)), expected) << text_of(t);
  }
  EXPECT_GT(found, 20000u);
}

TEST_F(Exact, DisjointBoxesShareOutTheVoxels) {
  Numbers numbers(5);
  for (int round = 0; round < 360; ++round) {
    const auto t = make_triangle(kAllKinds[round % 9], 9000, {1000, 2000, 3000}, numbers);
    const Box whole = bounding_voxels(t);
    const auto all = sorted(list(t, kEverywhere, scratch_));
    // Cut anywhere on each axis, also outside the triangle.
    Index cut;
    for (int axis = 0; axis < 3; ++axis) cut[axis] = numbers.within(whole.lo[axis] - 1, whole.hi[axis] + 1);
    std::vector<Index> joined;
    for (int part = 0; part < 8; ++part) {
      Box box = survey::grown(whole, 3);
      for (int axis = 0; axis < 3; ++axis) (((part >> axis) & 1) != 0 ? box.lo : box.hi)[axis] = cut[axis];
      const auto some = list(t, box, scratch_);
      ASSERT_EQ(static_cast<std::int64_t>(some.size()), count(t, box, scratch_));
      ASSERT_TRUE(std::all_of(some.begin(), some.end(), [&](const Index& p) { return box.contains(p); }));
      joined.insert(joined.end(), some.begin(), some.end());
    }
    ASSERT_EQ(sorted(joined), all) << text_of(t);
  }
}

TEST_F(Exact, DoesNotDependOnTheOrderOfTheCorners) {
  Numbers numbers(6);
  for (int round = 0; round < 450; ++round) {
    auto t = make_triangle(kAllKinds[round % 9], 3000, {0, 0, 0}, numbers);
    const auto expected = list(t, kEverywhere, scratch_);
    std::swap(t[0], t[1]);
    EXPECT_EQ(list(t, kEverywhere, scratch_), expected) << text_of(t);
    std::swap(t[0], t[2]);
    EXPECT_EQ(list(t, kEverywhere, scratch_), expected) << text_of(t);
  }
}

class RowsOf final : public RowSink {
 public:
  void row(const Row& row) override {
    ASSERT_EQ(row.lo.size(), row.hi.size());
    ASSERT_FALSE(row.lo.empty());
    if (rows_ > 0) {
      ASSERT_GT(row.v, last_v_);
    }
    last_v_ = row.v;
    u_axis_ = row.u_axis;
    v_axis_ = row.v_axis;
    w_axis_ = row.w_axis;
    ++rows_;
    columns_ += row.lo.size();
  }
  int rows_ = 0;
  int u_axis_ = -1;
  int v_axis_ = -1;
  int w_axis_ = -1;
  std::size_t columns_ = 0;
  std::int64_t last_v_ = 0;
};

TEST_F(Exact, RunsAlongTheSamplesOfSteepFaces) {
  RowsOf steep;  // normal along the inlines
  exact_rows({{{0, 0, 0}, {100, 9000, 0}, {-100, 0, 9000}}}, kEverywhere, scratch_, steep);
  EXPECT_EQ(steep.w_axis_, 0);
  EXPECT_EQ(steep.v_axis_, 1);
  EXPECT_EQ(steep.u_axis_, 2);
  RowsOf flat;  // normal along the samples
  exact_rows({{{0, 0, 0}, {9000, 0, 100}, {0, 9000, -100}}}, kEverywhere, scratch_, flat);
  EXPECT_EQ(flat.w_axis_, 2);
  EXPECT_EQ(flat.u_axis_, 1);
}

TEST_F(Exact, LooksOnlyAtColumnsInsideTheBox) {
  // 4000 x 4000 voxels in all; a box of 10 x 10 columns on it.
  const LatticeTriangle t = {{{0, 0, 0}, {0, 1024000, 0}, {0, 0, 1024000}}};
  RowsOf seen;
  exact_rows(t, {{-5, 100, 200}, {5, 110, 210}}, scratch_, seen);
  EXPECT_EQ(seen.rows_, 10);
  EXPECT_EQ(seen.columns_, 100u);
}

TEST_F(Exact, LooksOnlyAtColumnsThatReachTheBoxInDepth) {
  // Inclined 1:2 along u: of up to 2000 columns in a row, a slab of 10 voxels is met by about 20.
  const LatticeTriangle t = {{{0, 0, 0}, {0, 2560, 0}, {256000, 0, 512000}}};
  RowsOf seen;
  exact_rows(t, {{500, -100, -100}, {510, 10000, 10000}}, scratch_, seen);
  EXPECT_GT(seen.rows_, 0);
  EXPECT_LE(seen.columns_, 40u * static_cast<std::size_t>(seen.rows_));
}

TEST_F(Exact, AnEmptyOrDistantBoxYieldsNothing) {
  const LatticeTriangle t = {{{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}}};
  EXPECT_EQ(count(t, {{0, 0, 0}, {0, 5, 5}}, scratch_), 0);
  EXPECT_EQ(count(t, {{5, 5, 5}, {2, 2, 2}}, scratch_), 0);
  EXPECT_EQ(count(t, {{100, 100, 100}, {200, 200, 200}}, scratch_), 0);
}

TEST_F(Exact, StaysUsableAfterASinkThrew) {
  class Throwing final : public RowSink {
   public:
    void row(const Row&) override { throw 7; }
  } throwing;
  const LatticeTriangle t = {{{0, 0, 0}, {2000, 0, 0}, {0, 2000, 100}}};
  EXPECT_THROW(exact_rows(t, kEverywhere, scratch_, throwing), int);
  expect_definition(t, bounding_voxels(t));
}

}  // namespace
}  // namespace footwall::voxelize
