// decide() of engine/isosurface/case_tables.h
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <random>
#include <set>

#include "random_cells.h"
#include "rounds.h"

namespace footwall::isosurface {
namespace {

using boost::multiprecision::cpp_int;

// The cell as a neighbour may see it: axes exchanged and mirrored. Corner c stands where corner to[c] stood.
struct Turn {
  std::array<unsigned, 3> axis;  // new axis n is the old axis[n]
  unsigned mirrored;             // bit n: along the old axis n

  unsigned corner(unsigned c) const {
    unsigned old = 0;
    for (unsigned n = 0; n < 3; ++n) old |= (c >> n & 1U) << axis[n];
    return old ^ mirrored;
  }
  unsigned face(unsigned f) const { return 2 * axis[f / 2] + ((f & 1U) ^ (mirrored >> axis[f / 2] & 1U)); }
};

std::vector<Turn> all_turns() {
  std::vector<Turn> turns;
  std::array<unsigned, 3> axis{0, 1, 2};
  do {
    for (unsigned mirrored = 0; mirrored < 8; ++mirrored) turns.push_back({axis, mirrored});
  } while (std::next_permutation(axis.begin(), axis.end()));
  return turns;
}

// The decision in a turned cell, told in the faces of the original one.
Alternative decided_turned(const Turn& turn, const Values& values, float isovalue) {
  Values turned{};
  for (unsigned c = 0; c < 8; ++c) turned[c] = values[turn.corner(c)];
  const Alternative there = decide(signs_of(turned, isovalue), turned, isovalue);
  unsigned here = there & (kTunnelAbove | kTunnelBelow);
  for (unsigned f = 0; f < 6; ++f) here |= (there >> f & 1U) << turn.face(f);
  return static_cast<Alternative>(here);
}

TEST(Decide, AgreesWithTheSampledTrilinearField) {
  std::mt19937_64 random(5);
  std::set<std::pair<unsigned, unsigned>> met;
  int decided = 0;
  const int cells = rounds(10000);
  for (int n = 0; n < cells; ++n) {
    const unsigned signs = static_cast<unsigned>(n) % 256;
    const Values values = random_values(signs, random);
    const Alternative alternative = decide(signs, values, 0);
    ASSERT_TRUE(has_pattern(signs, alternative)) << signs << " " << int{alternative};
    met.insert({signs, alternative});
    std::array<double, 8> field{};
    std::copy(values.begin(), values.end(), field.begin());
    const auto sampled = verify::trilinear_level_set(field);
    if (!sampled) continue;  // a saddle at the isovalue
    ++decided;
    const verify::LevelSet meant = meaning(signs, alternative);
    ASSERT_EQ(meant.euler, sampled->euler) << n << " signs " << signs << " alternative " << int{alternative};
    ASSERT_EQ(meant, *sampled) << n << " signs " << signs << " alternative " << int{alternative};
  }
  EXPECT_GT(decided, cells * 9 / 10);
  EXPECT_GT(met.size(), 500U);
  RecordProperty("alternatives", static_cast<int>(met.size()));
}

// Two opposite corners far above, the others just below.
TEST(Decide, FindsTheTunnelBetweenOppositeCorners) {
  for (unsigned corner = 0; corner < 4; ++corner) {
    Values values{};
    values.fill(-1);
    values[corner] = values[7 - corner] = 100;
    EXPECT_EQ(decide(signs_of(values), values, 0), kTunnelAbove);
    for (float& each : values) each = -each;
    EXPECT_EQ(decide(signs_of(values), values, 0), kTunnelBelow);
    values.fill(-100);
    values[corner] = values[7 - corner] = 1;
    EXPECT_EQ(decide(signs_of(values), values, 0), 0);
  }
}

// Opposite corners at 3 in a cell of -1: in the middle slice ((3 - 1) / 2)^2 = (-1)^2.
TEST(Decide, ASaddleAtTheIsovalueJoinsTheCornersAbove) {
  Values values{};
  values.fill(-1);
  values[0] = values[7] = 3;
  EXPECT_EQ(decide(signs_of(values), values, 0), kTunnelAbove);
  values[0] = std::nextafter(3.F, 0.F);
  EXPECT_EQ(decide(signs_of(values), values, 0), 0);
  values.fill(1);
  values[0] = values[7] = -3;
  EXPECT_EQ(decide(signs_of(values), values, 0), 0);
  values[0] = std::nextafter(-3.F, -4.F);
  EXPECT_EQ(decide(signs_of(values), values, 0), kTunnelBelow);
  // A face: 2 * 2 = 4 * 1.
  Values flat{2, -4, -1, 2, -9, -9, -9, -9};
  EXPECT_EQ(decide(signs_of(flat), flat, 0), 1U << 4);
  flat[1] = std::nextafter(-4.F, -5.F);
  EXPECT_EQ(decide(signs_of(flat), flat, 0), 0);
  // The same below: the corners above stay joined.
  Values below{-2, 4, 1, -2, 9, 9, 9, 9};
  EXPECT_EQ(decide(signs_of(below), below, 0), 1U << 4);
}

TEST(Decide, DoesNotDependOnHowTheCellLies) {
  const std::vector<Turn> turns = all_turns();
  std::mt19937_64 random(6);
  for (int n = 0; n < rounds(4000); ++n) {
    const unsigned signs = static_cast<unsigned>(random() % 256);
    if (!is_undecided(signs)) continue;
    Values values = random_values(signs, random);
    if (n % 2 == 0) {
      for (float& each : values) each *= std::ldexp(1.F, static_cast<int>(random() % 200) - 100);
    }
    const Alternative here = decide(signs, values, 0);
    for (const Turn& turn : turns) ASSERT_EQ(decided_turned(turn, values, 0), here) << n;
  }
}

cpp_int in_smallest_floats(float value) {
  int exponent = 0;
  const float mantissa = std::frexp(value, &exponent);
  const cpp_int whole = static_cast<std::int64_t>(std::ldexp(mantissa, 24));
  return exponent + 125 >= 0 ? cpp_int(whole << (exponent + 125)) : cpp_int(whole >> -(exponent + 125));
}

// With a = 1 + p and d = 1 - p, b = c = -1 the saddle is at the isovalue -p^2 / 4: products that differ in
// bits which no double holds.
TEST(Decide, FacesAreExactForFloatsOfAnySize) {
  std::mt19937_64 random(8);
  int hard = 0;
  int joined = 0;
  for (int n = 0; n < rounds(5000); ++n) {
    const auto p = std::ldexp(static_cast<float>(1 + random() % 1000), -23);
    const float scale = std::ldexp(1.F, static_cast<int>(random() % 120) - 60);
    float isovalue = -p * p / 4 * scale;
    for (auto steps = random() % 4; steps > 0; --steps)
      isovalue = std::nextafter(isovalue, n % 2 == 0 ? 0.F : -scale);
    const Values values{(1 + p) * scale, -scale,     -scale,     (1 - p) * scale,
                        -2 * scale,      -3 * scale, -2 * scale, -scale};
    const unsigned signs = signs_of(values, isovalue);
    ASSERT_EQ(signs, 0b1001U);
    const auto difference = [&](unsigned c) -> cpp_int {
      return in_smallest_floats(values[c]) - in_smallest_floats(isovalue);
    };
    const cpp_int saddle = difference(0) * difference(3) - difference(1) * difference(2);
    const auto rough = [&](unsigned c) {
      return static_cast<double>(values[c]) - static_cast<double>(isovalue);
    };
    hard += (saddle >= 0) != (rough(0) * rough(3) - rough(1) * rough(2) >= 0) ? 1 : 0;
    joined += saddle >= 0 ? 1 : 0;
    ASSERT_EQ(decide(signs, values, isovalue), saddle >= 0 ? 1U << 4 : 0U) << n;
  }
  EXPECT_GT(hard, 100);
  EXPECT_GT(joined, 100);
}

TEST(Decide, InfiniteValuesAreDecidedAlikeOnBothSidesOfAFace) {
  const float infinite = std::numeric_limits<float>::infinity();
  std::mt19937_64 random(9);
  const std::vector<Turn> turns = all_turns();
  for (int n = 0; n < 2000; ++n) {
    Values values{};
    for (float& each : values) {
      const std::array<float, 6> choices{infinite, -infinite, 1, -1, 3e38F, -1e-45F};
      each = choices[random() % choices.size()];
    }
    const unsigned signs = signs_of(values);
    const Alternative here = decide(signs, values, 0);
    ASSERT_TRUE(has_pattern(signs, here));
    for (const Turn& turn : turns) ASSERT_EQ(decided_turned(turn, values, 0), here) << n;
  }
}

}  // namespace
}  // namespace footwall::isosurface
