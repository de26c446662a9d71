#include "engine/isosurface/seed_tables.h"

#include <gtest/gtest.h>

#include <random>

#include "random_cells.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

// Comparing positions is the asymptotic decider, but for rounding.
TEST(SeedTables, Seed000JoinsTheFacesOfTheTrilinearField) {
  std::mt19937_64 random(1);
  const CaseRules& rules = seed_000_rules();
  int same = 0;
  int asked = 0;
  for (int n = 0; n < 5000; ++n) {
    const unsigned signs = static_cast<unsigned>(random() % 256);
    const Values values = random_values(signs, random);
    if (!rules.undecided(signs)) continue;
    ++asked;
    same += rules.decide(signs, values, 0) == (decide(signs, values, 0) & 63) ? 1 : 0;
  }
  EXPECT_GT(asked, 1000);
  EXPECT_GT(same, asked * 98 / 100);
}

TEST(SeedTables, Seed002TurnsTheEntryOfTheComplementOver) {
  const CaseRules& rules = seed_002_rules();
  const Values any{};
  for (unsigned signs = 0; signs < 128; ++signs) {
    const Alternative here = rules.undecided(signs) ? rules.decide(signs, any, 0) : Alternative{0};
    const Alternative there =
        rules.undecided(255 - signs) ? rules.decide(255 - signs, any, 0) : Alternative{0};
    const Pattern& a = rules.pattern(signs, here);
    const Pattern& b = rules.pattern(255 - signs, there);
    ASSERT_EQ(a.triangles.size(), b.triangles.size()) << signs;
    for (std::size_t n = 0; n < a.triangles.size(); ++n) {
      EXPECT_EQ(a.triangles[n][0], b.triangles[n][0]);
      EXPECT_EQ(a.triangles[n][1], b.triangles[n][2]);
      EXPECT_EQ(a.triangles[n][2], b.triangles[n][1]);
    }
  }
  // Two corners across a face are kept apart, and so are the two below in the complement.
  EXPECT_EQ(rules.pattern(0b1001, rules.decide(0b1001, any, 0)).triangles.size(), 2U);
  EXPECT_EQ(rules.pattern(255 - 0b1001, rules.decide(255 - 0b1001, any, 0)).triangles.size(), 2U);
}

TEST(SeedTables, AreFoundByName) {
  EXPECT_EQ(&rules_of("trilinear"), &trilinear_rules());
  EXPECT_EQ(&rules_of("seed000"), &seed_000_rules());
  EXPECT_EQ(&rules_of("seed002"), &seed_002_rules());
  EXPECT_THROW(rules_of("lorensen"), Error);
}

}  // namespace
}  // namespace footwall::isosurface
